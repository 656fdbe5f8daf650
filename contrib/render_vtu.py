#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Draws the surface of a tetrahedral mesh (a cycle_NNN.vtu) as .svg or .png.

Needs nothing but Python's standard library. The surface may be coloured by a
cell or point array, deformed by the displacement, and cut open:

  contrib/render_vtu.py output/quickstart/cycle_003.vtu mesh.svg
  contrib/render_vtu.py -c von_mises -d 0.2 --keep 'y<0.5' cycle_003.vtu mesh.png

The faces between kept and dropped cells are drawn as well, so that --keep shows
the inside of a mesh. An .svg holds every triangle and suits some 5 000 of them;
larger meshes are better drawn as .png.
"""

import argparse
import array
import base64
import math
import re
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zlib

TYPE_CODES = {"Int8": "b", "UInt8": "B", "Int16": "h", "UInt16": "H", "Int32": "i",
              "UInt32": "I", "Int64": "q", "UInt64": "Q", "Float32": "f", "Float64": "d"}
# Outward faces of a tetrahedron of positive volume.
TET_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
TET_TYPES = (10, 24)
# From low to high: dark blue, blue-green, yellow, red.
COLOURS = ((48, 72, 150), (70, 150, 190), (170, 210, 170), (250, 215, 110), (190, 45, 40))
PLAIN = (205, 214, 228)


class VtuFile:
    """The arrays of a .vtu: inline ascii or base64, or appended raw or base64,
    with or without zlib compression."""

    def __init__(self, path):
        with open(path, "rb") as file:
            content = file.read()
        self.appended, self.appended_is_base64 = b"", False
        start = content.find(b"<AppendedData")
        if start >= 0:
            tag_end = content.index(b">", start)
            self.appended_is_base64 = b"base64" in content[start:tag_end]
            self.appended = content[content.index(b"_", tag_end) + 1:]
            content = content[:start] + b"</VTKFile>"
        root = ElementTree.fromstring(content)
        self.order = ">" if root.get("byte_order") == "BigEndian" else "<"
        self.header = {"UInt64": "Q"}.get(root.get("header_type"), "I")
        self.compressed = root.get("compressor") is not None
        if self.compressed and root.get("compressor") != "vtkZLibDataCompressor":
            raise ValueError("only zlib compression can be read")
        self.piece = root.find("UnstructuredGrid/Piece")
        if self.piece is None:
            raise ValueError("no UnstructuredGrid in this file")

    def names(self, section):
        return [a.get("Name") for a in self.piece.findall(section + "/DataArray")]

    def read(self, section, name=None):
        """Values of an array as a flat array.array, and its number of components."""
        for element in self.piece.findall(section + "/DataArray"):
            if name is None or element.get("Name") == name:
                return self._values(element), int(element.get("NumberOfComponents") or 1)
        raise ValueError(f"no array '{name}' in {section}")

    def _values(self, element):
        code = TYPE_CODES[element.get("type")]
        form = element.get("format")
        if form == "ascii":
            convert = float if code in "fd" else int
            return array.array(code, [convert(v) for v in (element.text or "").split()])
        if form == "appended":
            stored = memoryview(self.appended)[int(element.get("offset")):]
            data = self._decode(stored, self.appended_is_base64)
        else:
            data = self._decode((element.text or "").strip().encode(), True)
        values = array.array(code)
        values.frombytes(data)
        if (self.order == ">") != (sys.byteorder == "big"):
            values.byteswap()
        return values

    def _decode(self, stored, is_base64):
        size = struct.calcsize(self.header)

        def numbers(n):
            length = 4 * ((n * size + 2) // 3) if is_base64 else n * size
            raw = base64.b64decode(bytes(stored[:length])) if is_base64 else bytes(stored[:length])
            return struct.unpack(f"{self.order}{n}{self.header}", raw[:n * size]), length

        (first,), length = numbers(1)
        if not self.compressed:
            if is_base64:  # header and data are one base64 text
                length = 4 * ((size + first + 2) // 3)
                return base64.b64decode(bytes(stored[:length]))[size:size + first]
            return bytes(stored[length:length + first])
        header, length = numbers(3 + first)
        sizes = header[3:]
        data = stored[length:length + (4 * ((sum(sizes) + 2) // 3) if is_base64 else sum(sizes))]
        if is_base64:
            data = base64.b64decode(bytes(data))
        blocks, at = [], 0
        for block in sizes:
            blocks.append(zlib.decompress(bytes(data[at:at + block])))
            at += block
        return b"".join(blocks)


def read_cells(vtu):
    """Corner numbers of the tetrahedra, and their cell numbers."""
    connectivity = vtu.read("Cells", "connectivity")[0]
    offsets = vtu.read("Cells", "offsets")[0]
    types = vtu.read("Cells", "types")[0]
    cells, numbers, start = [], [], 0
    for i, end in enumerate(offsets):
        if types[i] in TET_TYPES:
            cells.append(tuple(connectivity[start:start + 4]))
            numbers.append(i)
        start = end
    return cells, numbers


def keep_cells(cells, numbers, points, condition):
    """Those with a centroid that fulfils a condition such as x<0.5."""
    match = re.fullmatch(r"\s*([xyz])\s*([<>])\s*(\S+)\s*", condition)
    if not match:
        raise ValueError(f"--keep '{condition}' is not of the form x<0.5")
    axis, below, bound = "xyz".index(match[1]), match[2] == "<", 4. * float(match[3])
    kept = [i for i, c in enumerate(cells)
            if (sum(points[3 * v + axis] for v in c) < bound) == below]
    return [cells[i] for i in kept], [numbers[i] for i in kept]


def surface(cells):
    """Outward faces that belong to one cell only: (a, b, c, index into cells)."""
    faces = {}
    for i, cell in enumerate(cells):
        for a, b, c in TET_FACES:
            face = (cell[a], cell[b], cell[c])
            key = tuple(sorted(face))
            if key in faces:
                del faces[key]
            else:
                faces[key] = (*face, i)
    return list(faces.values())


def face_values(vtu, name, faces, numbers, logarithmic):
    """One value a face, from a cell array or the mean of a point array; of a vector
    its length. Mapped to 0..1, with the range."""
    section = "CellData" if name in vtu.names("CellData") else "PointData"
    if name not in vtu.names(section):
        raise ValueError(f"no array '{name}'; there are " + ", ".join(
            vtu.names("PointData") + vtu.names("CellData")))
    data, n = vtu.read(section, name)

    def value(i):
        return data[i] if n == 1 else math.sqrt(sum(v * v for v in data[n * i:n * i + n]))

    if section == "CellData":
        values = [value(numbers[f[3]]) for f in faces]
    else:
        values = [(value(f[0]) + value(f[1]) + value(f[2])) / 3. for f in faces]
    if logarithmic:
        positive = [v for v in values if v > 0.]
        low = min(positive, default=1.)
        values = [math.log10(max(v, low)) for v in values]
    low, high = min(values), max(values)
    span = high - low or 1.
    return [(v - low) / span for v in values], (low, high)


def colour(value):
    position = min(max(value, 0.), 1.) * (len(COLOURS) - 1)
    i = min(int(position), len(COLOURS) - 2)
    t = position - i
    return tuple(a + t * (b - a) for a, b in zip(COLOURS[i], COLOURS[i + 1]))


def project(points, used, azimuth, elevation):
    """Picture coordinates (right, down) and depth (towards the eye) of points, seen
    in parallel projection with z upwards."""
    a, e = math.radians(azimuth), math.radians(elevation)
    right = (-math.sin(a), math.cos(a), 0.)
    eye = (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))
    up = (-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e))

    def dot(u, i):
        return u[0] * points[3 * i] + u[1] * points[3 * i + 1] + u[2] * points[3 * i + 2]

    return {i: (dot(right, i), -dot(up, i), dot(eye, i)) for i in used}


def shaded_triangles(faces, values, projected):
    """Triangles that face the eye, far ones first: three corners and a colour."""
    triangles = []
    for k, (a, b, c, _) in enumerate(faces):
        p, q, r = projected[a], projected[b], projected[c]
        u = [q[i] - p[i] for i in range(3)]
        v = [r[i] - p[i] for i in range(3)]
        # Down, not up, is the second coordinate: the normal's sign changes.
        n = (-(u[1] * v[2] - u[2] * v[1]), -(u[2] * v[0] - u[0] * v[2]),
             -(u[0] * v[1] - u[1] * v[0]))
        length = math.sqrt(n[0] ** 2 + n[1] ** 2 + n[2] ** 2)
        if length == 0. or n[2] <= 1e-6 * length:
            continue
        # A lamp at the upper left, behind the eye.
        light = (-0.35 * n[0] - 0.45 * n[1] + 0.82 * n[2]) / length
        shade = 0.55 + 0.45 * max(light, 0.)
        base = PLAIN if values is None else colour(values[k])
        # Few shades make small files.
        rgb = tuple(min(255, 4 * round(shade * x / 4.)) for x in base)
        triangles.append((p[2] + q[2] + r[2], (p, q, r), rgb))
    triangles.sort(key=lambda t: t[0])
    return triangles


def fit(triangles, width, margin):
    """Scales to the picture's width; returns the height as well."""
    xs = [p[0] for t in triangles for p in t[1]]
    ys = [p[1] for t in triangles for p in t[1]]
    left, top = min(xs), min(ys)
    extent = max(xs) - left or 1.
    # Not higher than wide.
    extent = max(extent, max(ys) - top)
    scale = (width - 2 * margin) / extent
    height = math.ceil((max(ys) - top) * scale) + 2 * margin
    shift = margin + 0.5 * (extent - (max(xs) - left)) * scale
    return [([((p[0] - left) * scale + shift, (p[1] - top) * scale + margin) for p in corners], rgb)
            for _, corners, rgb in triangles], height


def write_svg(path, triangles, width, height, edges):
    """Coordinates are tenths of a pixel; neighbours of one colour share a path."""
    classes, body, last = {}, [], None
    for corners, rgb in triangles:
        x = [round(10 * p[0]) for p in corners]
        y = [round(10 * p[1]) for p in corners]
        text = f"M{x[0]} {y[0]}l{x[1] - x[0]} {y[1] - y[0]} {x[2] - x[1]} {y[2] - y[1]}z"
        text = text.replace(" -", "-")
        if rgb == last:
            body[-1] += text
        else:
            name = classes.setdefault(rgb, f"c{len(classes)}")
            body.append(f'<path class="{name}" d="{text}')
            last = rgb
    styles = "".join(f".{name}{{fill:#{r:02x}{g:02x}{b:02x}}}" for (r, g, b), name in classes.items())
    stroke = f"stroke:#223;stroke-width:{round(10 * edges)}" if edges > 0 else "stroke:none"
    with open(path, "w", encoding="ascii") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
                   f'viewBox="0 0 {10 * width} {10 * height}"><style>path{{{stroke};'
                   f'stroke-linejoin:round}}{styles}</style>\n')
        file.write("\n".join(line + '"/>' for line in body) + "\n</svg>\n")


def fill_triangle(rows, corners, rgb, width, height):
    """Pixels with a centre inside, row by row."""
    (x0, y0), (x1, y1), (x2, y2) = sorted(corners, key=lambda p: p[1])
    fill = bytes(rgb)
    for y in range(max(0, math.ceil(y0 - 0.5)), min(height - 1, math.floor(y2 - 0.5)) + 1):
        centre = y + 0.5
        a = x0 + (x2 - x0) * (centre - y0) / (y2 - y0)
        if centre < y1:
            b = x0 + (x1 - x0) * (centre - y0) / (y1 - y0)
        else:
            b = x1 + (x2 - x1) * (centre - y1) / (y2 - y1) if y2 > y1 else x1
        if a > b:
            a, b = b, a
        first, last = max(0, math.ceil(a - 0.5)), min(width - 1, math.floor(b - 0.5))
        if last >= first:
            rows[y][3 * first:3 * last + 3] = fill * (last - first + 1)


def draw_line(rows, p, q, rgb, width, height):
    steps = max(1, math.ceil(max(abs(q[0] - p[0]), abs(q[1] - p[1]))))
    for i in range(steps + 1):
        x = int(p[0] + (q[0] - p[0]) * i / steps)
        y = int(p[1] + (q[1] - p[1]) * i / steps)
        if 0 <= x < width and 0 <= y < height:
            rows[y][3 * x:3 * x + 3] = rgb


def write_png(path, triangles, width, height, edges):
    """Drawn at twice the size and averaged, so that edges are smooth."""
    w, h = 2 * width, 2 * height
    rows = [bytearray(b"\xff" * (3 * w)) for _ in range(h)]
    for corners, rgb in triangles:
        doubled = [(2 * p[0], 2 * p[1]) for p in corners]
        fill_triangle(rows, doubled, rgb, w, h)
        if edges > 0:
            line = bytes(int(0.35 * x) for x in rgb)
            for i in range(3):
                draw_line(rows, doubled[i], doubled[(i + 1) % 3], line, w, h)
    lines = bytearray()
    for y in range(height):
        upper, lower = rows[2 * y], rows[2 * y + 1]
        pixels = bytearray(3 * width)
        for c in range(3):
            # Even and odd pixels of a channel; few levels make small files.
            pixels[c::3] = bytes((a + b + d + e) // 4 & 0xFC | 3 for a, b, d, e in zip(
                upper[c::6], upper[c + 3::6], lower[c::6], lower[c + 3::6]))
        lines += b"\0" + pixels

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(
            ">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n"
                   + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(bytes(lines), 9)) + chunk(b"IEND", b""))


def draw(options):
    if not options.picture.endswith((".svg", ".png")):
        raise ValueError(f"the picture '{options.picture}' must end in .svg or .png")
    vtu = VtuFile(options.vtu)
    points = list(vtu.read("Points")[0])
    cells, numbers = read_cells(vtu)
    for condition in options.keep:
        cells, numbers = keep_cells(cells, numbers, points, condition)
    if not cells:
        raise ValueError("there are no tetrahedra to draw")
    faces = surface(cells)
    if options.deform:
        displacement, _ = vtu.read("PointData", "displacement")
        points = [p + options.deform * u for p, u in zip(points, displacement)]
    values, message = None, ""
    if options.colour:
        values, (low, high) = face_values(vtu, options.colour, faces, numbers, options.log)
        message = f", {'log10 ' if options.log else ''}{options.colour} {low:.4g} to {high:.4g}"
    azimuth, elevation = (float(v) for v in options.view.split(","))
    projected = project(points, {v for f in faces for v in f[:3]}, azimuth, elevation)
    triangles, height = fit(shaded_triangles(faces, values, projected), options.width, 4)
    write = write_svg if options.picture.endswith(".svg") else write_png
    write(options.picture, triangles, options.width, height, options.edges)
    print(f"{options.picture}: {len(triangles)} triangles{message}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vtu", help="a .vtu file")
    parser.add_argument("picture", help="an .svg or .png file to write")
    parser.add_argument("-c", "--colour", metavar="ARRAY", help="cell or point array to show")
    parser.add_argument("--log", action="store_true", help="colour by the array's logarithm")
    parser.add_argument("-d", "--deform", type=float, default=0., metavar="FACTOR",
                        help="add the displacement times this factor (default: 0)")
    parser.add_argument("--keep", action="append", default=[], metavar="CONDITION",
                        help="draw only cells with a centroid there, e.g. 'x<0.5'; repeatable")
    parser.add_argument("--view", default="-60,25", metavar="AZIMUTH,ELEVATION",
                        help="where the eye is, in degrees (default: -60,25); "
                             "write --view=-60,25 with a minus sign")
    parser.add_argument("--width", type=int, default=900, help="pixels (default: 900)")
    parser.add_argument("--edges", type=float, default=0.6,
                        help="width of the mesh's edges in pixels, 0: none (default: 0.6)")
    options = parser.parse_args()
    try:
        draw(options)
    except (OSError, ValueError, IndexError, KeyError, struct.error, zlib.error,
            ElementTree.ParseError) as error:
        print(f"render_vtu: {options.vtu}: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
