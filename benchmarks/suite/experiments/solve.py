# SPDX-License-Identifier: AGPL-3.0-or-later
"""One mesh of the cantilever, about 200 000 unknowns, degree 2, read by every program from a file.

Whole processes; and Tetradapt's solve alone (numbering, assembly, set-up, iterations to 1e-8) in units
of one product with the assembled matrix as PETSc stores it, timed in this session.
"""
from suite import plots
from suite.bodies import CANTILEVER as body


def run(session):
    n = 6 if session.quick else 9
    jobs = [session.tetradapt.shared(session.output, body, n, 2)]
    jobs += [program.job(session.output, body, n, 2) for program in session.others]
    cases = session.measure(jobs, spend=8 if session.quick else 20)
    product = product_seconds(session, n)
    ours = next(c for c in cases if c.job.program == "Tetradapt")
    rows = []
    for case in sorted(cases, key=lambda c: c.median("cpu")):
        row = {**case.row(), "dofs": case.result["dofs"], "iterations": case.result.get("iterations", ""),
               "cpu_over_tetradapt": f"{case.median('cpu') / ours.median('cpu'):.3g}",
               "memory_over_tetradapt": f"{case.median('memory') / ours.median('memory'):.3g}",
               "products_whole": f"{case.median('cpu') / product:.4g}" if product else ""}
        if case is ours and product:
            row["products_solve"] = f"{case.value('cpu_solve') / product:.3g}"
            row["product_seconds"] = f"{product:.4g}"
        rows.append(row)
    session.write("solve", rows)
    plots.bars(session.path("solve.svg"),
               {r["program"]: {"CPU seconds": r["cpu_seconds"], "memory, 100 MB": r["memory_mb"] / 100}
                for r in rows},
               f"One mesh, {rows[0]['dofs']} unknowns, degree 2: whole process", "", stacked=False)


def product_seconds(session, n):
    """CPU seconds of one product with the matrix in compressed rows; None without FEniCSx."""
    fenicsx = [p for p in session.others if p.name == "FEniCSx GAMG"]
    if not fenicsx:
        session.say("  no FEniCSx: the solve is not given in products with the matrix")
        return None
    job = fenicsx[0].job(session.output, body, n, 2, "40")
    cases = session.measure([job], repeats=1)
    return cases[0].value("seconds_product") if cases else None
