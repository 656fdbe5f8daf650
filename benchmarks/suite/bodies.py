# SPDX-License-Identifier: AGPL-3.0-or-later
"""The two bodies of the suite. Both have a singular edge, and an energy that is known.

The measure of the error is the same for every program: ||u - u_h|| = sqrt(|E - E_h|) in the energy
norm, E = a(u,u), by Galerkin orthogonality. That holds for the cantilever, since it is clamped, and
for the L-shaped solid, since every mesh represents its prescribed displacements exactly.
"""
import dataclasses
import math

from suite.lattice import Lattice


@dataclasses.dataclass(frozen=True)
class Body:
    """planes: name -> (axis, coordinate); held: (plane, component, value); tractions: (plane,
    vector); energy: a(u,u), which is twice the strain energy; boxes: in multiples of `unit`."""
    name: str
    scene: str
    planes: dict
    held: tuple
    tractions: tuple
    energy: float
    boxes: tuple
    unit: float
    young: float
    poisson: float = 0.3

    def lattice(self, n):
        """Uniform mesh with n bricks over `unit`."""
        boxes = [([n * c for c in a], [n * c for c in b]) for a, b in self.boxes]
        return Lattice(boxes, self.unit / n)

    def dofs(self, n, degree):
        """Displacement unknowns of that mesh, prescribed ones included."""
        m = n * degree
        points = sum(math.prod(m * (b - a) + 1 for a, b in zip(*box)) for box in self.boxes)
        shared = 0
        if self.name == "l_shape":  # neighbours share 2m + 1 by m + 1 points
            shared = 2 * (2 * m + 1) * (m + 1)
        return 3 * (points - shared)

    def error(self, energy):
        """Relative error in the energy norm."""
        return math.sqrt(abs(1 - energy / self.energy))


# 10 x 1 x 1, clamped at x = 0, traction (0, 0, -1) at x = 10; the edges of the clamp are singular.
# Energy: extrapolated from graded hexahedra of high degree, +- 2e-6.
CANTILEVER = Body(
    name="cantilever", scene="cantilever.prm", unit=1., young=1000.,
    boxes=(((0, 0, 0), (10, 1, 1)),),
    planes={"CLAMP": (0, 0.), "TIP": (0, 10.)},
    held=(("CLAMP", 0, 0.), ("CLAMP", 1, 0.), ("CLAMP", 2, 0.)),
    tractions=(("TIP", (0., 0., -1.)),),
    energy=4.004143)

# A quarter of a plate of thickness 1/2 with a square hole, stretched in y, in plane strain: only
# the re-entrant edge is singular. Energy: benchmarks/l_shape_energy.py, +- 3e-9.
L_SHAPE = Body(
    name="l_shape", scene="l_shape.prm", unit=0.5, young=1.,
    boxes=(((0, 0, 0), (2, 2, 1)), ((0, 2, 0), (2, 4, 1)), ((2, 2, 0), (4, 4, 1))),
    planes={"BOTTOM": (1, 0.), "TOP": (1, 2.), "RIGHT": (0, 2.), "BACK": (2, 0.), "FRONT": (2, 0.5)},
    held=(("BOTTOM", 1, 0.), ("TOP", 1, 1.), ("RIGHT", 0, 0.), ("BACK", 2, 0.), ("FRONT", 2, 0.)),
    tractions=(),
    energy=0.291907896)

BODIES = {body.name: body for body in (CANTILEVER, L_SHAPE)}
