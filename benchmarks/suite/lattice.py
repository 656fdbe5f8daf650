# SPDX-License-Identifier: AGPL-3.0-or-later
"""Uniform tetrahedra on bodies made of boxes, and the files in which programs read them.

Every brick of a grid is cut into six tetrahedra along its diagonal (Kuhn), the mesh that box
generators make. The nodes of degree 2 are the points of the grid of half the spacing: each of
them halves one edge. So every program gets the same nodes without searching.
"""
import array
import itertools
import json
import os
import sys

# The corners of a tetrahedron: from (0, 0, 0) to (1, 1, 1) along the axes, in every order.
_PATHS = list(itertools.permutations(range(3)))
# Middle nodes in the order of Abaqus, CalculiX: of the edges 01, 12, 20, 03, 13, 23.
_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


def _is_even(permutation):
    return sum(a > b for a, b in itertools.combinations(permutation, 2)) % 2 == 0


class Lattice:
    """A union of boxes cut into bricks.

    boxes    pairs of lower and upper corners in bricks (whole numbers)
    spacing  edge length of a brick
    nodes    points (i, j, k) of the grid of half the spacing, those with even numbers (the
             corners of tetrahedra) first
    cells    ten nodes each, corners first
    """

    def __init__(self, boxes, spacing):
        self.spacing = spacing
        bricks = set()
        for lower, upper in boxes:
            bricks.update(itertools.product(*(range(a, b) for a, b in zip(lower, upper))))
        self.bricks = sorted(bricks)
        points = {(2 * i + a, 2 * j + b, 2 * k + c) for i, j, k in self.bricks
                  for a, b, c in itertools.product(range(3), repeat=3)}
        self.nodes = sorted(points, key=lambda p: (p[0] % 2 + p[1] % 2 + p[2] % 2 > 0, p))
        self.n_corners = sum(1 for p in self.nodes if all(c % 2 == 0 for c in p))
        self.number = {p: n for n, p in enumerate(self.nodes)}
        self.cells = [cell for brick in self.bricks for cell in self._cut(brick)]

    def _cut(self, brick):
        for path in _PATHS:
            corner = [2 * c for c in brick]
            corners = [tuple(corner)]
            for axis in path:
                corner[axis] += 2
                corners.append(tuple(corner))
            if not _is_even(path):
                corners[1], corners[2] = corners[2], corners[1]
            middles = [tuple((a + b) // 2 for a, b in zip(corners[m], corners[n]))
                       for m, n in _EDGES]
            yield [self.number[p] for p in corners + middles]

    def n_nodes(self, degree):
        return self.n_corners if degree == 1 else len(self.nodes)

    def position(self, node):
        return tuple(c * self.spacing / 2 for c in self.nodes[node])

    def on_plane(self, axis, coordinate, degree):
        """Nodes with that coordinate."""
        wanted = round(2 * coordinate / self.spacing)
        return [n for n in range(self.n_nodes(degree)) if self.nodes[n][axis] == wanted]

    def face_weights(self, axis, coordinate, degree):
        """The integral of each shape function over that plane, {node: area}."""
        plane = set(self.on_plane(axis, coordinate, 2))
        area = self.spacing**2 / 2
        weights = {}
        for cell in self.cells:
            loaded = [n for n in (cell[:4] if degree == 1 else cell[4:]) if n in plane]
            if len(loaded) == 3:
                for node in loaded:
                    weights[node] = weights.get(node, 0.) + area / 3
        return weights


def write_gmsh(lattice, path):
    """The corners and linear tetrahedra, Gmsh format 2.2 (GetFEM reads it in ASCII only)."""
    with open(path, "w", encoding="ascii") as file:
        file.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{lattice.n_corners}\n")
        file.writelines("%d %.17g %.17g %.17g\n" % (n + 1, *lattice.position(n))
                        for n in range(lattice.n_corners))
        file.write(f"$EndNodes\n$Elements\n{len(lattice.cells)}\n")
        file.writelines("%d 4 2 0 0 %d %d %d %d\n" % (e + 1, *(n + 1 for n in cell[:4]))
                        for e, cell in enumerate(lattice.cells))
        file.write("$EndElements\n")


def write_arrays(lattice, stem):
    """stem.points (doubles, x y z) and stem.cells (64-bit numbers, four a tetrahedron)."""
    points, cells = array.array("d"), array.array("q")
    for n in range(lattice.n_corners):
        points.extend(lattice.position(n))
    for cell in lattice.cells:
        cells.extend(cell[:4])
    for name, values in (("points", points), ("cells", cells)):
        with open(f"{stem}.{name}", "wb") as file:
            values.tofile(file)


def write_calculix(lattice, body, degree, solver, path):
    """The deck of one linear static step; loads are the exact nodal forces of a traction."""
    count = 4 if degree == 1 else 10
    with open(path, "w", encoding="ascii") as file:
        file.write("*NODE, NSET=ALL\n")
        file.writelines("%d,%.17g,%.17g,%.17g\n" % (n + 1, *lattice.position(n))
                        for n in range(lattice.n_nodes(degree)))
        file.write(f"*ELEMENT, TYPE=C3D{count}, ELSET=BODY\n")
        file.writelines("%d,%s\n" % (e + 1, ",".join(str(n + 1) for n in cell[:count]))
                        for e, cell in enumerate(lattice.cells))
        file.write("*MATERIAL, NAME=M\n*ELASTIC\n%.17g,%.17g\n" % (body.young, body.poisson))
        file.write("*SOLID SECTION, ELSET=BODY, MATERIAL=M\n")
        for name, (axis, coordinate) in body.planes.items():
            file.write(f"*NSET, NSET={name}\n")
            file.writelines(f"{n + 1}\n" for n in lattice.on_plane(axis, coordinate, degree))
        file.write(f"*STEP\n*STATIC, SOLVER={solver}\n*BOUNDARY\n")
        for name, component, value in body.held:
            file.write("%s,%d,%d,%.17g\n" % (name, component + 1, component + 1, value))
        for name, traction in body.tractions:
            file.write("*CLOAD\n")
            for node, weight in sorted(lattice.face_weights(*body.planes[name], degree).items()):
                file.writelines("%d,%d,%.17g\n" % (node + 1, c + 1, t * weight)
                                for c, t in enumerate(traction) if t)
        if body.tractions:
            file.write(f"*NODE PRINT, NSET={body.tractions[0][0]}\nU\n")
        else:
            for name in {name for name, _, value in body.held if value}:
                file.write(f"*NODE PRINT, NSET={name}, TOTALS=ONLY\nRF\n")
        file.write("*END STEP\n")


def main():
    """lattice.py BODY N STEM: all files of one mesh. In a process of its own, for memory's sake."""
    from suite.bodies import BODIES
    body, n, stem = BODIES[sys.argv[1]], int(sys.argv[2]), sys.argv[3]
    grid = body.lattice(n)
    write_arrays(grid, stem)
    write_gmsh(grid, stem + ".msh")
    for degree in (1, 2):
        write_calculix(grid, body, degree, "SPOOLES", f"{stem}_p{degree}.inp")
        weights = {name: grid.face_weights(*body.planes[name], degree)
                   for name, _ in body.tractions}
        with open(f"{stem}_p{degree}.weights", "w", encoding="ascii") as file:
            json.dump(weights, file)
    with open(stem + ".done", "w", encoding="ascii"):
        pass


if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    main()
