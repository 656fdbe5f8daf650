# SPDX-License-Identifier: AGPL-3.0-or-later
"""One and two MPI ranks, uniform mesh of the cantilever, degree 2, wall seconds."""
import os
import shutil

from suite.bodies import CANTILEVER as body


def run(session):
    if not shutil.which("mpirun") or os.cpu_count() < 2:
        session.say("  left out: no mpirun, or one processor only")
        return
    n = 9 if session.quick else 16
    jobs = [session.tetradapt.uniform(session.output, body, n, 2, ranks) for ranks in (1, 2)]
    cases = session.measure(jobs, repeats=5, spend=200)
    rows = []
    # The least of the runs: with both processors busy, any other process on the machine shows.
    for case in cases:
        rows.append({**case.row(), "dofs": case.result["dofs"], "iterations": case.result["iterations"],
                     "wall_seconds_least": f"{min(s.wall for s in case.samples):.4g}",
                     "solve_wall_seconds_least": min(s.result["wall_solve"] for s in case.samples)})
    for row in rows:
        for name in ("wall_seconds_least", "solve_wall_seconds_least"):
            row[name.replace("_seconds_least", "_faster")] = (
                f"{float(rows[0][name]) / float(row[name]):.3g}")
    session.write("ranks", rows)
