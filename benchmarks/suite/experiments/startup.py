# SPDX-License-Identifier: AGPL-3.0-or-later
"""Start-up: the smallest problem, 10 bricks of degree 1, and nothing at all."""
import os

from suite.bodies import CANTILEVER as body
from suite.programs import Job


def run(session):
    tetradapt = session.tetradapt
    jobs = [Job("Tetradapt", "--version", "-", 0, [tetradapt.binary, "--version"], session.output,
                lambda text: {}),
            tetradapt.uniform(session.output, body, 1, 1)]
    jobs += [program.job(session.output, body, 1, 1) for program in session.others]
    os.sync()
    session.write("startup", [case.row() for case in session.measure(jobs, repeats=5, warm=True)])
