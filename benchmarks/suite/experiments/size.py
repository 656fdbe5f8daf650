# SPDX-License-Identifier: AGPL-3.0-or-later
"""Cost and memory from 10^4 to 3 x 10^6 unknowns, uniform meshes of the cantilever."""
from suite import plots
from suite.bodies import CANTILEVER as body

# (quick, full) fineness by degree.
FINENESS = {1: ((6, 12, 20), (6, 14, 21, 30)), 2: ((3, 6, 9), (3, 6, 9, 15, 23))}


def run(session):
    rows = []
    jobs = []
    for degree, choices in FINENESS.items():
        jobs += [session.tetradapt.uniform(session.output, body, n, degree)
                 for n in choices[0 if session.quick else 1]]
    for case in session.measure(jobs, spend=8 if session.quick else 15):
        dofs = case.result["dofs"]
        rows.append({**case.row(), "dofs": dofs, "iterations": case.result["iterations"],
                     "solve_cpu_seconds": case.value("cpu_solve"),
                     "whole_microseconds_per_dof": f"{1e6 * case.median('cpu') / dofs:.4g}",
                     "solve_microseconds_per_dof": f"{1e6 * case.value('cpu_solve') / dofs:.4g}",
                     "kilobytes_per_dof": f"{1e3 * case.median('memory') / dofs:.4g}"})
    session.write("size", rows)
    draw(session, rows)


def draw(session, rows):
    series, memory = {}, {}
    for row in rows:
        name = f", P{row['degree']}"
        for key, text in (("whole_microseconds_per_dof", "whole process"),
                          ("solve_microseconds_per_dof", "solve alone")):
            series.setdefault(text + name, []).append((row["dofs"], float(row[key])))
        if row["degree"] == 2:
            memory.setdefault("Tetradapt", []).append((row["dofs"], float(row["kilobytes_per_dof"])))
    plots.lines(session.path("size.svg"), series, "Tetradapt: CPU time of one unknown", "unknowns",
                "microseconds per unknown")
    # The others solved the same meshes in the experiment before.
    for row in session.read(f"error_{body.name}"):
        if row["program"] != "Tetradapt" and row["degree"] == "2":
            dofs = int(row["dofs"])
            memory.setdefault(row["program"], []).append((dofs, 1e3 * float(row["memory_mb"]) / dofs))
    plots.lines(session.path("memory.svg"), memory, "Memory of one unknown, degree 2, whole process",
                "unknowns", "kB per unknown")
