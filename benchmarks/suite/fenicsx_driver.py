#!/usr/bin/python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""FEniCSx on one mesh: fenicsx_driver.py BODY MESH DEGREE SOLVER [PRODUCTS].

SOLVER is gamg (conjugate gradients to a residual of 1e-8, PETSc's algebraic multigrid with the
rigid-body modes) or cholesky (MUMPS). MESH is what lattice.write_arrays() wrote. Prints one line of JSON.
PRODUCTS > 0: also times that many products with the assembled matrix.
"""
import json
import os
import sys
import time

import numpy as np
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI
from petsc4py import PETSc

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from suite.bodies import BODIES  # noqa: E402

# Forms are compiled once and kept by FEniCSx; these flags make the kernels as fast as they get.
JIT = {"cffi_extra_compile_args": ["-O3", "-march=native", "-ffast-math"]}
SOLVERS = {
    "gamg": {"ksp_type": "cg", "ksp_rtol": 1e-8, "ksp_norm_type": "unpreconditioned",
             "pc_type": "gamg", "pc_gamg_threshold": 0.01, "mg_levels_ksp_type": "chebyshev",
             "mg_levels_pc_type": "jacobi", "mg_levels_ksp_max_it": 2,
             "mg_levels_esteig_ksp_type": "cg"},
    "cholesky": {"ksp_type": "preonly", "pc_type": "cholesky",
                 "pc_factor_mat_solver_type": "mumps"},
}


def read_mesh(stem):
    """The mesh, in the way of the installed version."""
    points = np.fromfile(stem + ".points").reshape(-1, 3)
    cells = np.fromfile(stem + ".cells", dtype=np.int64).reshape(-1, 4)
    try:
        import basix.ufl
        shape = ufl.Mesh(basix.ufl.element("Lagrange", "tetrahedron", 1, shape=(3,)))
    except (ImportError, AttributeError, TypeError):
        shape = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.tetrahedron, 1))
    return mesh.create_mesh(MPI.COMM_WORLD, cells, points, shape)


def vector_space(domain, degree):
    if hasattr(fem, "functionspace"):
        return fem.functionspace(domain, ("Lagrange", degree, (3,)))
    return fem.VectorFunctionSpace(domain, ("Lagrange", degree))


def compiled(form):
    try:
        return fem.form(form, jit_options=JIT)
    except TypeError:
        return fem.form(form, jit_params=JIT)


def vector_of(function):
    return function.x.petsc_vec if hasattr(function.x, "petsc_vec") else function.vector


def rigid_motions(space):
    """Orthonormal null space of the matrix without supports."""
    block = space.dofmap.index_map_bs
    n = space.dofmap.index_map.size_local * block
    x = space.tabulate_dof_coordinates()[:n // block]
    modes = np.zeros((6, n))
    for c in range(3):
        modes[c, c::block] = 1
        a, b = (c + 1) % 3, (c + 2) % 3
        modes[3 + c, a::block] = -x[:, b]
        modes[3 + c, b::block] = x[:, a]
    modes = np.linalg.qr(modes.T)[0].T
    vectors = []
    for mode in modes:
        vector = PETSc.Vec().createMPI((n, PETSc.DETERMINE), comm=space.mesh.comm)
        vector.array = mode
        vectors.append(vector)
    return PETSc.NullSpace().create(vectors=vectors, comm=space.mesh.comm)


def problem(body, domain, degree):
    """Space, forms and supports."""
    space = vector_space(domain, degree)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    mu = body.young / (2 * (1 + body.poisson))
    lam = body.young * body.poisson / ((1 + body.poisson) * (1 - 2 * body.poisson))
    eps = ufl.sym(ufl.grad(u))
    stress = 2 * mu * eps + lam * ufl.tr(eps) * ufl.Identity(3)
    facets = {name: mesh.locate_entities_boundary(
        domain, 2, lambda x, a=axis, c=value: np.isclose(x[a], c))
        for name, (axis, value) in body.planes.items()}
    supports = [fem.dirichletbc(PETSc.ScalarType(value),
                                fem.locate_dofs_topological(space.sub(c), 2, facets[name]),
                                space.sub(c))
                for name, c, value in body.held]
    load = ufl.inner(fem.Constant(domain, PETSc.ScalarType((0, 0, 0))), v) * ufl.dx
    for name, value in body.tractions:
        marks = mesh.meshtags(domain, 2, np.sort(facets[name]),
                              np.full(len(facets[name]), 1, dtype=np.int32))
        ds = ufl.Measure("ds", domain=domain, subdomain_data=marks, subdomain_id=1)
        load = ufl.inner(fem.Constant(domain, PETSc.ScalarType(value)), v) * ds
    return space, compiled(ufl.inner(stress, ufl.grad(v)) * ufl.dx), compiled(load), supports


def main():
    body, stem, degree, solver = BODIES[sys.argv[1]], sys.argv[2], int(sys.argv[3]), sys.argv[4]
    products = int(sys.argv[5]) if len(sys.argv) > 5 else 0
    start = time.process_time()
    domain = read_mesh(stem)
    space, stiffness, load, supports = problem(body, domain, degree)
    matrix = fem_petsc.assemble_matrix(stiffness, bcs=supports)
    matrix.assemble()
    right = fem_petsc.assemble_vector(load)
    fem_petsc.apply_lifting(right, [stiffness], bcs=[supports])
    right.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    fem_petsc.set_bc(right, supports)
    matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    matrix.setOption(PETSc.Mat.Option.SPD, True)
    if solver == "gamg":
        matrix.setNearNullSpace(rigid_motions(space))
    assembled = time.process_time()
    options = PETSc.Options()
    for key, value in SOLVERS[solver].items():
        options[key] = value
    ksp = PETSc.KSP().create(domain.comm)
    ksp.setOperators(matrix)
    ksp.setFromOptions()
    solution = fem.Function(space)
    ksp.solve(right, vector_of(solution))
    solution.x.scatter_forward()
    solved = time.process_time()
    # a(u,u), with the forms that are compiled already: the residual without supports, times u.
    result = {"dofs": space.dofmap.index_map.size_global * space.dofmap.index_map_bs,
              "iterations": ksp.getIterationNumber(), "converged": ksp.getConvergedReason() > 0,
              "energy": energy(body, matrix, right, solution, stiffness, supports),
              "seconds_assembly": assembled - start, "seconds_solve": solved - assembled}
    if products:
        x, y = matrix.createVecs()
        x.set(1.)
        matrix.mult(x, y)
        samples = []
        for _ in range(5):
            begin = time.process_time()
            for _ in range(products):
                matrix.mult(x, y)
            samples.append((time.process_time() - begin) / products)
        result["seconds_product"] = min(samples)
        result["non_zeros"] = matrix.getInfo()["nz_used"]
    print(json.dumps(result))


def energy(body, matrix, right, solution, stiffness, supports):
    """a(u,u): the work of the loads, or that of the supports that move."""
    if body.tractions:
        return vector_of(solution).dot(right)
    free = fem_petsc.assemble_matrix(stiffness)
    free.assemble()
    forces = vector_of(solution).duplicate()
    free.mult(vector_of(solution), forces)
    return vector_of(solution).dot(forces)


if __name__ == "__main__":
    main()
