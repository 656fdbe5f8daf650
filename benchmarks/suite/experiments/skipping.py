# SPDX-License-Identifier: AGPL-3.0-or-later
"""What scenes skip, and the CPU time that it saves against a run that is made to do it."""
import os
import re
import types

from suite.bodies import BODIES

ESTIMATORS = "spr, residual, averaging, interpolation, equilibrated, degree extrapolation"
REFERENCE = {"Reference/Type": "hexahedra", "Reference/Tolerance": 0.0025, "Reference/Cache": "no"}
OUTPUT = {"Output/VTU": "yes", "Output/Stress": "yes", "Output/Plots": "yes",
          "Output/Size field": "yes"}
# What a run can be made to do that the scene does not need.
FORCED = {
    "stresses and .vtu of every cycle": {"Output/VTU": "yes", "Output/Stress": "yes"},
    "plots": {"Output/Plots": "yes"},
    "all estimators": {"Estimation/Estimators": ESTIMATORS},
    "a reference solution": {**REFERENCE, "Estimation/Estimators": "energy, ren"},
    "multigrid for every system": {"Solver/Type": "cg"},
    "residuals of 1e-8 in every cycle": {"Solver/Stopping": "residual"},
    "all of these": {**OUTPUT, **REFERENCE, "Solver/Type": "cg", "Solver/Stopping": "residual",
                     "Estimation/Estimators": ESTIMATORS + ", energy, ren"},
}


def stages_of(folder):
    """How many stages a run's log says are needed and skipped."""
    count = {"needs": 0, "skips": 0}
    section = None
    with open(os.path.join(folder, "log.txt"), encoding="utf-8") as file:
        for line in file:
            text = line.split("] ", 1)[-1].strip() if line.startswith("[") else line.strip()
            if text in count:
                section = text
            elif section and not text:
                break
            elif section and re.search(r"\S\s{2,}\S", text):
                count[section] += 1
    return count


# A scene with a reference, which is solved once and kept.
QUICKSTART = types.SimpleNamespace(name="quickstart", scene=os.path.join("..", "quickstart.prm"))
OF_QUICKSTART = {
    "a new reference solution": {"Reference/Cache": "no"},
    "plots and size field": {"Output/Plots": "yes", "Output/Size field": "yes"},
    "all estimators": {"Estimation/Estimators": ESTIMATORS},
    "all of these": {"Reference/Cache": "no", "Output/Plots": "yes", "Output/Size field": "yes",
                     "Estimation/Estimators": ESTIMATORS},
}


def run(session):
    rows = []
    base = {"Adaptivity/Refinement indicator": "spr", "Adaptivity/Tolerance": 0.01}
    for body in BODIES.values():
        rows += compare(session, body, 2, base, FORCED)
    rows += compare(session, QUICKSTART, 1, {}, OF_QUICKSTART)
    session.write("skipping", rows)


def compare(session, body, degree, base, forced):
    """Rows of one scene: as it is, and with each of the settings that force more."""
    jobs = [session.tetradapt.job(session.output, body, "as it is", degree, base)]
    jobs += [session.tetradapt.job(session.output, body, name, degree, {**base, **settings})
             for name, settings in forced.items()]
    cases = session.measure(jobs, warm=True)
    plain = cases[0].median("cpu")
    for case in cases:
        folder = case.job.command[case.job.command.index("--output-directory") + 1]
        count = stages_of(folder)
        yield {**case.row(), "stages_needed": count["needs"], "stages_skipped": count["skips"],
               "seconds_saved": f"{case.median('cpu') - plain:.3g}",
               "times_as_long": f"{case.median('cpu') / plain:.3g}"}
