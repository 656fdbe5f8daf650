# SPDX-License-Identifier: AGPL-3.0-or-later
"""Run time against the true error, whole processes, Tetradapt beside other programs.

The others solve on uniform meshes of growing fineness, ready-made. Tetradapt does the same, and
refines to tolerances that its own estimate has to meet: every cycle, meshing and estimation is
counted, and no reference is used unless the indicator needs one.
"""
from suite import levels, plots
from suite.bodies import BODIES

# Fineness of the uniform meshes, by body and degree: (quick, full).
UNIFORM = {("cantilever", 1): ((4, 8, 12), (4, 8, 14, 20)),
           ("cantilever", 2): ((2, 4, 6), (2, 4, 6, 9, 12)),
           ("l_shape", 1): ((4, 8, 12), (4, 8, 12, 18)),
           ("l_shape", 2): ((2, 4, 5), (2, 4, 6, 9))}
# The solvers take too long or too much memory beyond so many unknowns: (quick, full).
LARGEST = {"CalculiX SPOOLES": (70000, 120000), "CalculiX CG, Cholesky": (25000, 120000),
           "CalculiX CG, scaled": (25000, 80000), "GetFEM MUMPS": (25000, 80000),
           "FEniCSx Cholesky": (70000, 500000), "FEniCSx GAMG": (70000, 500000)}
INDICATORS = ("spr", "residual", "averaging", "equilibrated", "interpolation", "degree extrapolation",
              "local degree extrapolation", "richardson")
# By body and degree, the last one left out of quick sessions; smaller errors cost linear
# tetrahedra too much.
TOLERANCES = {("cantilever", 1): (0.4, 0.3, 0.2, 0.15), ("l_shape", 1): (0.2, 0.1, 0.06, 0.04),
              ("cantilever", 2): (0.2, 0.1, 0.05, 0.02, 0.01, 0.005),
              ("l_shape", 2): (0.1, 0.05, 0.02, 0.01, 0.005)}


def adaptive_jobs(session, body):
    tetradapt = session.tetradapt
    for degree in (1, 2):
        for indicator in INDICATORS:
            main = indicator in ("spr", "residual")
            if not main and (degree == 1 or session.quick):
                continue
            for tolerance in TOLERANCES[body.name, degree][:None if main and not session.quick else -1]:
                settings = {"Adaptivity/Refinement indicator": indicator, "Adaptivity/Tolerance": tolerance}
                yield tetradapt.job(session.output, body, f"{indicator} {tolerance}", degree, settings)
    for tolerance in () if session.quick else (0.05, 0.02):
        settings = {"Adaptivity/Refinement indicator": "energy", "Adaptivity/Tolerance": tolerance,
                    "Reference/Type": "hexahedra", "Reference/Tolerance": tolerance / 4,
                    "Reference/Cache": "no"}
        yield tetradapt.job(session.output, body, f"reference {tolerance}", 2, settings)


def uniform_jobs(session, body):
    for degree in (1, 2):
        for n in UNIFORM[body.name, degree][0 if session.quick else 1]:
            yield session.tetradapt.uniform(session.output, body, n, degree)
            for program in session.others:
                if body.dofs(n, degree) < LARGEST[program.name][0 if session.quick else 1]:
                    yield program.job(session.output, body, n, degree)


def unsolved(case, error, rows):
    """Whether the error differs by more than 2 % from that of the same mesh with Tetradapt."""
    key = case.job.case, str(case.job.degree)
    return any(abs(error / float(row["error"]) - 1) > 0.02 for row in rows
               if row["program"] == "Tetradapt" and (row["case"], str(row["degree"])) == key)


def run(session):
    for body in BODIES.values():
        rows = []
        # Quick: each once. Else the short ones, whose times scatter, three times.
        repeats, spend = (1, 1) if session.quick else (3, 4)
        jobs = [*uniform_jobs(session, body), *adaptive_jobs(session, body)]
        for case in session.measure(jobs, repeats, spend):
            error = body.error(case.value("energy"))
            if unsolved(case, error, rows):
                session.say(f"  left out: {case.job.label} did not solve its equations: error "
                            f"{error:.3g}, while that of the mesh is another")
                continue
            rows.append({**case.row(), "dofs": case.result["dofs"], "error": f"{error:.6g}",
                         "estimate": case.result.get("estimate", ""),
                         "cycles": case.result.get("cycles", "")})
        session.write(f"error_{body.name}", rows)
        write_levels(session, body, rows)
        draw(session, body, rows)


def write_levels(session, body, rows):
    """CPU seconds to certain errors, a row a curve."""
    curves = {}
    for row in rows:
        curves.setdefault(levels.curve(row), []).append(row)
    table = []
    for name, points in curves.items():
        line = {"curve": name, "runs": len(points),
                "least_error": min(float(p["error"]) for p in points)}
        for level in levels.LEVELS:
            line[f"seconds_to_{level:g}"] = levels.seconds(points, level)
        table.append(line)
    session.write(f"levels_{body.name}", table)


def draw(session, body, rows):
    """Two plots of the error over CPU seconds: all programs, and all indicators of Tetradapt.

    In the first the slower solvers of a program are left to the table.
    """
    title = {"cantilever": "Cantilever", "l_shape": "L-shaped solid"}[body.name]
    axes = "CPU seconds of the whole process, one thread", "relative error in the energy norm"
    programs, indicators = {}, {}
    for row in rows:
        kind = row["case"].rsplit(" ", 1)[0]
        point = float(row["cpu_seconds"]), float(row["error"])
        if row["program"] == "Tetradapt" and row["degree"] == 2:
            indicators.setdefault(kind, []).append(point)
        if kind in ("uniform", *INDICATORS[:2]) and "CG, " not in row["program"]:
            programs.setdefault(levels.curve(row), []).append(point)
    # Tetradapt first, refined before uniform, degree 2 before 1.
    programs = dict(sorted(programs.items(), key=lambda item: (
        not item[0].startswith("Tetradapt"), "uniform" in item[0], item[0][:-1], -int(item[0][-1]))))
    plots.lines(session.path(f"error_{body.name}.svg"), programs,
                f"{title}: true error against run time", *axes)
    if not session.quick:
        plots.lines(session.path(f"indicators_{body.name}.svg"), indicators,
                    f"{title}: what drives Tetradapt's refinement, degree 2", *axes)
