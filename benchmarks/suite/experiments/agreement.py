# SPDX-License-Identifier: AGPL-3.0-or-later
"""All programs on one and the same mesh: do they find the same energy?

The energy a(u,u) holds the whole solution. Direct solvers and conjugate gradients to 1e-8 have to
agree to 1e-8, CalculiX to the seven digits that it prints. CalculiX's own iterative solvers stop by
a rule of theirs that cannot be changed: their difference is shown, and not held against anybody.
"""
from suite.bodies import BODIES


def tolerance(program):
    if program.startswith("CalculiX"):
        return 2e-7 if "SPOOLES" in program else None
    return 1e-8


def run(session):
    jobs = []
    for body in BODIES.values():
        n = {"cantilever": 3, "l_shape": 4}[body.name]
        for degree in (1, 2):
            jobs.append(session.tetradapt.shared(session.output, body, n, degree))
            jobs += [program.job(session.output, body, n, degree) for program in session.others]
    rows, good = [], True
    cases = session.measure(jobs, repeats=1)
    ours = {(c.job.body, c.job.degree): c.result for c in cases if c.job.program == "Tetradapt"}
    for case in cases:
        reference = ours[case.job.body, case.job.degree]
        difference = abs(case.result["energy"] / reference["energy"] - 1)
        bound = tolerance(case.job.program)
        holds = bound is None or difference < bound
        same = case.result["dofs"] == reference["dofs"]
        good = good and holds and same
        if not (holds and same):
            session.say(f"  DISAGREES: {case.job.label}: {case.result}, Tetradapt: {reference}")
        rows.append({"body": case.job.body, "degree": case.job.degree, "program": case.job.program,
                     "dofs": case.result["dofs"], "energy": f"{case.result['energy']:.10g}",
                     "difference": f"{difference:.1e}",
                     "allowed": "-" if bound is None else f"{bound:.0e}",
                     "agrees": "-" if bound is None else "yes" if holds and same else "NO"})
    session.write("agreement", sorted(rows, key=lambda r: (r["body"], r["degree"])))
    return good
