#!/usr/bin/python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""The energy a(u,u) of the L-shaped solid of this suite, with FEniCSx in two dimensions.

It is in plane strain, so that the problem is one of the plane: quadrilaterals of growing degree
on a grid that is graded geometrically to the re-entrant corner. Prints the energy for several
degrees and gradings; suite/bodies.py states the digits that agree.
"""
import dolfinx
import numpy as np
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

THICKNESS, YOUNG, POISSON = 0.5, 1., 0.3


def graded_mesh(layers, factor):
    steps = factor ** np.arange(layers, 0, -1)
    line = np.concatenate([1 - steps[::-1] / factor, [1.], 1 + steps / factor])
    points, cells, number = [], [], {}

    def node(i, j):
        if (i, j) not in number:
            number[i, j] = len(points)
            points.append((line[i], line[j]))
        return number[i, j]
    for i in range(2 * layers):
        for j in range(2 * layers):
            if i < layers or j >= layers:
                cells.append([node(i, j), node(i + 1, j), node(i, j + 1), node(i + 1, j + 1)])
    shape = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.quadrilateral, 1))
    return mesh.create_mesh(MPI.COMM_WORLD, np.array(cells), np.array(points), shape)


def energy(domain, degree):
    space = fem.VectorFunctionSpace(domain, ("Lagrange", degree))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    mu = YOUNG / (2 * (1 + POISSON))
    lam = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))

    def form(a, b):
        return (2 * mu * ufl.inner(ufl.sym(ufl.grad(a)), ufl.sym(ufl.grad(b)))
                + lam * ufl.div(a) * ufl.div(b)) * ufl.dx

    def held(component, axis, coordinate, value):
        facets = mesh.locate_entities_boundary(
            domain, 1, lambda x: np.isclose(x[axis], coordinate, atol=1e-14))
        dofs = fem.locate_dofs_topological(space.sub(component), 1, facets)
        return fem.dirichletbc(PETSc.ScalarType(value), dofs, space.sub(component))
    problem = fem.petsc.LinearProblem(
        form(u, v), ufl.inner(fem.Constant(domain, PETSc.ScalarType((0, 0))), v) * ufl.dx,
        bcs=[held(1, 1, 0., 0.), held(1, 1, 2., 1.), held(0, 0, 2., 0.)],
        petsc_options={"ksp_type": "preonly", "pc_type": "lu",
                       "pc_factor_mat_solver_type": "mumps"})
    solution = problem.solve()
    return THICKNESS * fem.assemble_scalar(fem.form(form(solution, solution)))


def main():
    print("dolfinx", dolfinx.__version__)
    for layers, factor in ((8, 0.3), (10, 0.3), (12, 0.3), (8, 0.2)):
        domain = graded_mesh(layers, factor)
        for degree in (6, 8, 9):
            print(f"{layers} layers, factor {factor}, degree {degree}: "
                  f"{energy(domain, degree):.12f}", flush=True)


if __name__ == "__main__":
    main()
