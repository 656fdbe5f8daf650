# SPDX-License-Identifier: AGPL-3.0-or-later
"""Where an adaptive run's CPU time goes, by stage."""
from suite import plots
from suite.bodies import BODIES

STAGES = ("mesh", "solve", "estimate", "marking", "output", "other")


def run(session):
    jobs = []
    for body in BODIES.values():
        for indicator in ("spr", "residual"):
            for tolerance in (0.01,) if session.quick else (0.01, 0.005):
                settings = {"Adaptivity/Refinement indicator": indicator, "Adaptivity/Tolerance": tolerance,
                            "Output/VTU": "yes"}
                jobs.append(session.tetradapt.job(session.output, body, f"stages {indicator} {tolerance}", 2,
                                                  settings))
    rows = []
    for case in session.measure(jobs):
        total = case.value("cpu_total")
        parts = {stage: case.value(f"cpu_{stage}") for stage in STAGES
                 if f"cpu_{stage}" in case.result}
        row = {**case.row(), "dofs": case.result["dofs"], "cycles": case.result["cycles"]}
        row.update({f"cpu_{stage}": f"{value:.3g}" for stage, value in parts.items()})
        row["cpu_start_and_end"] = f"{max(0., case.median('cpu') - total):.3g}"
        rest = sum(parts.values()) - parts["solve"]
        row["all_but_solve_percent_of_run"] = f"{100 * rest / case.median('cpu'):.3g}"
        row["percent_of_stages"] = f"{100 * rest / total:.3g}"
        rows.append(row)
    session.write("stages", rows)
    names = [f"cpu_{stage}" for stage in STAGES if stage != "other"] + ["cpu_start_and_end"]
    plots.bars(session.path("stages.svg"),
               {f"{r['body']} {r['case'].split(' ', 1)[1]}":
                {n[4:].replace("_", " "): float(r.get(n) or 0.) for n in names} for r in rows},
               "Adaptive runs by stage (mesh: TetGen and transfer; output: with .vtu files)",
               "CPU seconds")
