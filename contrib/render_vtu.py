#!/usr/bin/python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Draws the surface of a mesh (a cycle_NNN.vtu) as .png, with a colour bar and axes.

Uses VTK's Python module (Debian: python3-vtk9) and needs no window: without a display
it starts itself in a virtual one (Debian: xvfb, xauth). The surface may be coloured by a
cell or point array, deformed by the displacement, and cut open:

  contrib/render_vtu.py output/quickstart/cycle_003.vtu mesh.png
  contrib/render_vtu.py -c von_mises --unit kPa -d 0.2 --keep 'y<0.5' cycle_003.vtu mesh.png

Colours span the 1st to the 99th percentile of what is shown, so that the few cells at a
singularity do not take all of them; the bar says so. Outliers get the last colours.
"""

import argparse
import math
import os
import shutil
import sys

# From low to high: dark blue, blue-green, yellow, red.
COLOURS = ((48, 72, 150), (70, 150, 190), (170, 210, 170), (250, 215, 110), (190, 45, 40))
PLAIN = (0.80, 0.84, 0.89)
DARK = (0.15, 0.15, 0.15)
LABELS = {"von_mises": "von Mises stress", "error_indicator": "error indicator", "ren": "REN",
          "displacement": "displacement"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vtu", help="a .vtu file")
    parser.add_argument("picture", help="the .png file to write")
    parser.add_argument("-c", "--colour", metavar="ARRAY", help="cell or point array to show")
    parser.add_argument("--unit", default="", help="of the array, for the colour bar: MPa")
    parser.add_argument("--length-unit", default="", metavar="UNIT",
                        help="for the axes: mm")
    parser.add_argument("--log", action="store_true", help="logarithmic colours")
    parser.add_argument("--percentiles", default="1,99", metavar="LOW,HIGH",
                        help="part of the values that the colours span (default: 1,99)")
    parser.add_argument("-d", "--deform", type=float, default=0., metavar="FACTOR",
                        help="add the displacement times this factor (default: 0)")
    parser.add_argument("--keep", action="append", default=[], metavar="CONDITION",
                        help="draw only cells with a centroid there, e.g. 'x<0.5'; repeatable")
    parser.add_argument("--view", default="-60,25", metavar="AZIMUTH,ELEVATION",
                        help="where the eye is, in degrees (default: -60,25); "
                             "write --view=-60,25 with a minus sign")
    parser.add_argument("--width", type=int, default=1200, help="pixels (default: 1200)")
    parser.add_argument("--height", type=int, default=0, help="pixels (default: 2/3 of the width)")
    parser.add_argument("--edges", type=float, default=0.6,
                        help="width of the mesh's edges in pixels, 0: none (default: 0.6)")
    parser.add_argument("--no-axes", action="store_true", help="leave the axes out")
    return parser.parse_args()


def enter_virtual_display():
    """Starts this script again in a virtual display, where it has none."""
    if os.environ.get("DISPLAY"):
        return
    if shutil.which("xvfb-run") is None:
        sys.exit("render_vtu.py: there is no display. Install Debian's xvfb and xauth.")
    os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", sys.executable]
              + sys.argv)


def numbers(text, count, what):
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != count:
        raise ValueError(f"{what}: '{text}' should be {count} numbers separated by a comma")
    return values


def read(path):
    if not os.path.isfile(path):
        raise ValueError(f"there is no file '{path}'")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    if grid is None or grid.GetNumberOfCells() == 0:
        raise ValueError(f"'{path}' has no cells: is it a .vtu file of this program?")
    return grid


def keep_cells(grid, conditions):
    """The cells whose centroids fulfil all conditions in x, y, z."""
    centres = vtk.vtkCellCenters()
    centres.SetInputData(grid)
    centres.Update()
    points = centres.GetOutput()
    names = {name: getattr(math, name) for name in ("sqrt", "sin", "cos", "exp", "pi")}
    names.update(abs=abs, min=min, max=max)
    kept = vtk.vtkIdList()
    try:
        codes = [compile(condition, "--keep", "eval") for condition in conditions]
        for cell in range(points.GetNumberOfPoints()):
            names["x"], names["y"], names["z"] = points.GetPoint(cell)
            # What is evaluated was typed in the user's own shell.
            if all(eval(code, {"__builtins__": {}}, names) for code in codes):
                kept.InsertNextId(cell)
    except Exception as trouble:
        raise ValueError(f"--keep {conditions}: {trouble}") from None
    if kept.GetNumberOfIds() == 0:
        raise ValueError("--keep leaves no cell")
    extract = vtk.vtkExtractCells()
    extract.SetInputData(grid)
    extract.SetCellList(kept)
    extract.Update()
    return extract.GetOutput()


def deformed(grid, factor):
    if grid.GetPointData().GetArray("displacement") is None:
        raise ValueError("the file has no displacement to deform the mesh by")
    grid.GetPointData().SetActiveVectors("displacement")
    warp = vtk.vtkWarpVector()
    warp.SetInputData(grid)
    warp.SetScaleFactor(factor)
    warp.Update()
    return warp.GetOutput()


def surface_of(grid):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    surface.SetNonlinearSubdivisionLevel(0)  # edges are those of the mesh
    surface.Update()
    return surface.GetOutput()


def value_of(components):
    return components[0] if len(components) == 1 else math.hypot(*components)


def shown_values(surface, name):
    """Puts the array to show, of a vector its length, into the surface as "shown"; returns
    its values and whether they are at points."""
    for data, at_points in ((surface.GetCellData(), False), (surface.GetPointData(), True)):
        array = data.GetArray(name)
        if array is None:
            continue
        shown = vtk.vtkDoubleArray()
        shown.SetName("shown")
        values = [value_of(array.GetTuple(i)) for i in range(array.GetNumberOfTuples())]
        for value in values:
            shown.InsertNextValue(value)
        data.AddArray(shown)
        data.SetActiveScalars("shown")
        return values, at_points
    names = sorted(data.GetArrayName(i) for data in (surface.GetCellData(), surface.GetPointData())
                   for i in range(data.GetNumberOfArrays()) if data.GetArrayName(i))
    raise ValueError(f"there is no array '{name}'; there are {', '.join(names)}")


def colour_range(values, percentiles, logarithmic):
    values = sorted(value for value in values
                    if math.isfinite(value) and (value > 0 or not logarithmic))
    if not values:
        raise ValueError("the array has no values that can be shown")
    low, high = (values[min(max(round(part / 100 * (len(values) - 1)), 0), len(values) - 1)]
                 for part in percentiles)
    if high <= low:  # a constant
        low, high = (low / 1.1, low * 1.1) if logarithmic else (low - 0.5, low + 0.5)
    is_clipped = low > values[0] or high < values[-1]
    return low, high, is_clipped


def colour_table(low, high, logarithmic):
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i in range(256):
        place = i / 255 * (len(COLOURS) - 1)
        lower = min(int(place), len(COLOURS) - 2)
        part = place - lower
        table.SetTableValue(i, *[((1 - part) * a + part * b) / 255
                                 for a, b in zip(COLOURS[lower], COLOURS[lower + 1])], 1)
    if logarithmic:
        table.SetScaleToLog10()
    table.SetTableRange(low, high)
    return table


def dark_text(text, size):
    text.SetColor(*DARK)
    text.SetFontFamilyToArial()
    text.SetFontSize(size)
    text.BoldOff()
    text.ItalicOff()
    text.ShadowOff()


def colour_bar(table, title, height):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(6)
    bar.SetLabelFormat("%-#.3g")
    bar.UnconstrainedFontSizeOn()
    dark_text(bar.GetTitleTextProperty(), height // 42)
    dark_text(bar.GetLabelTextProperty(), height // 46)
    bar.SetVerticalTitleSeparation(height // 50)
    bar.SetBarRatio(0.25)
    bar.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    bar.SetPosition(0.84, 0.14)
    bar.SetWidth(0.13)
    bar.SetHeight(0.72)
    return bar


def lengths_seen(bounds, camera):
    """Lengths of the body's three edges as the eye sees them."""
    normal = camera.GetDirectionOfProjection()
    return [(bounds[2 * i + 1] - bounds[2 * i]) * math.sqrt(max(0., 1 - normal[i] ** 2))
            for i in range(3)]


def range_text(low, high):
    """" = 0 to 1", rounded to a hundredth of the length."""
    step = 10. ** math.floor(math.log10(high - low)) / 100 if high > low else 1.
    return " = " + " to ".join(f"{round(end / step) * step:.4g}" for end in (low, high))


def axes_of(bounds, camera, unit, height):
    axes = vtk.vtkCubeAxesActor()
    axes.SetBounds(bounds)
    axes.SetCamera(camera)
    axes.SetFlyModeToOuterEdges()
    axes.SetTickLocationToOutside()
    axes.SetScreenSize(height / 65)
    seen = lengths_seen(bounds, camera)
    for axis, name in enumerate("XYZ"):
        title = name.lower()
        if seen[axis] < 0.45 * max(seen):  # numbers would lie on each other
            blanks = vtk.vtkStringArray()
            for _ in range(20):
                blanks.InsertNextValue(" ")
            axes.SetAxisLabels(axis, blanks)
            title += range_text(*bounds[2 * axis:2 * axis + 2])
        if seen[axis] < 0.06 * max(seen):  # seen from its end
            getattr(axes, f"{name}AxisVisibilityOff")()
            title = " "
        getattr(axes, f"Set{name}Title")(title)
        getattr(axes, f"Set{name}Units")(unit)
        getattr(axes, f"Set{name}LabelFormat")("%-#.3g")
        getattr(axes, f"{name}AxisMinorTickVisibilityOff")()
        getattr(axes, f"Get{name}AxesLinesProperty")().SetColor(*DARK)
        dark_text(axes.GetTitleTextProperty(axis), height // 40)
        dark_text(axes.GetLabelTextProperty(axis), height // 48)
    return axes


def place_camera(renderer, view, bounds):
    azimuth, elevation = (math.radians(angle) for angle in view)
    direction = (math.cos(azimuth) * math.cos(elevation), math.sin(azimuth) * math.cos(elevation),
                 math.sin(elevation))
    centre = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(c + d for c, d in zip(centre, direction)))
    camera.SetViewUp(*((0, 0, 1) if abs(direction[2]) < 0.99 else (0, 1, 0)))
    renderer.ResetCamera(bounds)
    return camera


def span(corners, direction):
    places = [sum(a * b for a, b in zip(corner, direction)) for corner in corners]
    return max(places) - min(places)


def fit(camera, bounds, aspect, with_bar):
    """Zooms so that the body and its axes fill what the colour bar leaves."""
    corners = [(bounds[i], bounds[2 + j], bounds[4 + k])
               for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    normal, right, up = camera.GetDirectionOfProjection(), [0.] * 3, [0.] * 3
    vtk.vtkMath.Cross(normal, camera.GetViewUp(), right)
    vtk.vtkMath.Normalize(right)
    vtk.vtkMath.Cross(right, normal, up)
    room = 0.74 if with_bar else 0.92
    scale = max(span(corners, up) / 0.78, span(corners, right) / (0.86 * room * aspect))
    camera.SetParallelScale(scale / 2)
    if with_bar:  # the body moves to the left
        shift = [(0.92 - room) / 2 * scale * aspect * part for part in right]
        camera.SetFocalPoint(*(a + b for a, b in zip(camera.GetFocalPoint(), shift)))
        camera.SetPosition(*(a + b for a, b in zip(camera.GetPosition(), shift)))


def draw(options):
    if not options.picture.lower().endswith(".png"):
        raise ValueError("the picture must be a .png file")
    width, height = options.width, options.height or options.width * 2 // 3
    grid = read(options.vtu)
    if options.keep:
        grid = keep_cells(grid, options.keep)
    if options.deform:
        grid = deformed(grid, options.deform)
    surface = surface_of(grid)

    mapper = vtk.vtkPolyDataMapper()
    actor = vtk.vtkActor()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    if options.colour:
        values, at_points = shown_values(surface, options.colour)
        percentiles = numbers(options.percentiles, 2, "--percentiles")
        low, high, is_clipped = colour_range(values, percentiles, options.log)
        table = colour_table(low, high, options.log)
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
        mapper.SetScalarModeToUsePointData() if at_points else mapper.SetScalarModeToUseCellData()
        title = LABELS.get(options.colour, options.colour.replace("_", " "))
        title += f"\n[{options.unit}]" if options.unit else "\n[scene's unit]"
        if is_clipped:
            title += f"\nclipped at {percentiles[0]:g} %\nand {percentiles[1]:g} %"
        renderer.AddActor2D(colour_bar(table, title, height))
    else:
        mapper.ScalarVisibilityOff()
        actor.GetProperty().SetColor(*PLAIN)
    mapper.SetInputData(surface)
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.6)
    actor.GetProperty().SetDiffuse(0.4)
    if options.edges > 0:
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.2, 0.2, 0.2)
        actor.GetProperty().SetLineWidth(options.edges)
    renderer.AddActor(actor)

    bounds = surface.GetBounds()
    camera = place_camera(renderer, numbers(options.view, 2, "--view"), bounds)
    fit(camera, bounds, width / height, bool(options.colour))
    if not options.no_axes:
        renderer.AddActor(axes_of(bounds, camera, options.length_unit, height))
    if options.deform:
        note = vtk.vtkTextActor()
        note.SetInput(f"displacement times {options.deform:g}")
        dark_text(note.GetTextProperty(), height // 46)
        note.SetPosition(width // 60, height // 60)
        renderer.AddActor2D(note)
    renderer.ResetCameraClippingRange()
    write(renderer, width, height, options.picture)


def write(renderer, width, height, path):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.Update()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    if not os.path.isfile(path):
        raise ValueError(f"'{path}' could not be written")


if __name__ == "__main__":
    ARGUMENTS = parse_arguments()
    try:
        import vtk
    except ImportError as missing:
        sys.exit(f"render_vtu.py: {missing}. Install Debian's python3-vtk9.")
    enter_virtual_display()
    try:
        draw(ARGUMENTS)
    except (ValueError, OSError) as wrong:
        sys.exit(f"render_vtu.py: {wrong}")
