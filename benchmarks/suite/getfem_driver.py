#!/usr/bin/python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""GetFEM on one mesh: getfem_driver.py BODY MESH DEGREE (MUMPS). Prints one line of JSON.

MESH.msh is what lattice.write_gmsh() wrote, read by GetFEM's own importer.
"""
import json
import os
import sys

import getfem as gf
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from suite.bodies import BODIES  # noqa: E402


def faces_on(grid, axis, value):
    """Elements and local faces of the outer boundary on a plane."""
    return grid.faces_from_pid(np.flatnonzero(np.abs(grid.pts()[axis] - value) < 1e-9))


def main():
    body, stem, degree = BODIES[sys.argv[1]], sys.argv[2], int(sys.argv[3])
    gf.util("trace level", 0)
    grid = gf.Mesh("import", "gmsh", stem + ".msh")
    for number, (axis, value) in enumerate(body.planes.values()):
        grid.set_region(number + 1, faces_on(grid, axis, value))
    number = {name: n + 1 for n, name in enumerate(body.planes)}
    fem = gf.MeshFem(grid, 3)
    fem.set_classical_fem(degree)
    data = gf.MeshFem(grid, 1)
    data.set_classical_fem(0)
    mu = body.young / (2 * (1 + body.poisson))
    lam = body.young * body.poisson / ((1 + body.poisson) * (1 - 2 * body.poisson))
    ones = np.ones(data.nbdof())
    # Exact quadrature on straight tetrahedra.
    matrix = gf.asm_linear_elasticity(gf.MeshIm(grid, 2 * degree - 2), fem, data, lam * ones, mu * ones)
    load = np.zeros(fem.nbdof())
    for name, value in body.tractions:
        load += gf.asm_boundary_source(number[name], gf.MeshIm(grid, 2), fem, data,
                                       np.outer(value, ones))
    u = np.zeros(fem.nbdof())
    free = np.ones(fem.nbdof(), dtype=bool)
    for name, component, value in body.held:
        held = fem.basic_dof_on_region(number[name])[component::3]
        u[held] = value
        free[held] = False
    inner = np.flatnonzero(free)
    right = (load - matrix.mult(u))[inner]
    u[inner] = np.ravel(gf.linsolve_mumps(gf.Spmat("copy", matrix, inner, inner), right))
    print(json.dumps({"dofs": fem.nbdof(), "energy": float(u @ matrix.mult(u)),
                      "converged": bool(np.isfinite(u).all())}))


if __name__ == "__main__":
    main()
