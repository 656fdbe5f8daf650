# SPDX-License-Identifier: AGPL-3.0-or-later
"""Whole processes measured from outside: CPU and wall seconds, peak memory."""
import dataclasses
import os
import signal
import statistics
import subprocess
import tempfile
import threading
import time

OPENBLAS = "/usr/lib/{}-linux-gnu/openblas-pthread".format(os.uname().machine)


@dataclasses.dataclass
class Sample:
    """One run. cpu: user and system, children included, seconds; memory: largest resident set
    of the process or of one of its children, MB; result: what the program said."""
    cpu: float
    wall: float
    memory: float
    result: dict


class Failure(RuntimeError):
    """A program that ended with an error, or took too long."""


def environment():
    """One thread each, and OpenBLAS for all where it is installed."""
    env = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", CCX_NPROC_EQUATION_SOLVER="1",
               OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", LC_ALL="C.UTF-8")
    if os.path.isdir(OPENBLAS):
        path = env.get("LD_LIBRARY_PATH")
        env["LD_LIBRARY_PATH"] = OPENBLAS + (":" + path if path else "")
    return env


def run(job, limit=900.):
    """Runs a job (see programs.py) once."""
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        begin = time.monotonic()
        process = subprocess.Popen(job.command, cwd=job.folder, env=environment(), stdout=out,
                                   stderr=err, stdin=subprocess.DEVNULL, start_new_session=True)
        timer = threading.Timer(limit, lambda: os.killpg(process.pid, signal.SIGKILL))
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - begin
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        text, trouble = out.read(), err.read()
    if process.returncode != 0:
        raise Failure(f"{job.label}: exit code {process.returncode} after {wall:.0f} s: "
                      f"{(trouble or text)[-600:]}")
    return Sample(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024, job.parse(text))


@dataclasses.dataclass
class Case:
    """A job and its samples."""
    job: object
    samples: list = dataclasses.field(default_factory=list)
    failure: str = ""

    def median(self, name):
        return statistics.median(getattr(s, name) for s in self.samples)

    def value(self, name):
        """Median of a number of the program's own."""
        return statistics.median(s.result[name] for s in self.samples)

    @property
    def result(self):
        return self.samples[-1].result

    def row(self):
        """The columns that all tables begin with."""
        job = self.job
        return {"body": job.body, "program": job.program, "case": job.case, "degree": job.degree,
                "runs": len(self.samples), "cpu_seconds": round(self.median("cpu"), 4),
                "cpu_seconds_least": round(min(s.cpu for s in self.samples), 4),
                "cpu_seconds_most": round(max(s.cpu for s in self.samples), 4),
                "wall_seconds": round(self.median("wall"), 4),
                "memory_mb": round(self.median("memory"), 1)}


def measure(jobs, repeats, spend, say, warm=False):
    """Runs all jobs in turns, so that a disturbance meets all of them alike.

    repeats runs each, but no further run of a job that has taken more than `spend` seconds. warm:
    one run before, not counted, for files that must be in memory. Returns the cases that ran.
    """
    cases = [Case(job) for job in jobs]
    for turn in range(-1 if warm else 0, repeats):
        for case in cases:
            if case.failure or sum(s.wall for s in case.samples) > spend:
                continue
            try:
                sample = run(case.job)
            except Failure as failure:
                case.failure = str(failure)
                say(f"  FAILED {case.failure}")
                continue
            if turn >= 0:
                case.samples.append(sample)
                say(f"  {case.job.label:50s} {sample.cpu:9.2f} s CPU {sample.wall:9.2f} s wall "
                    f"{sample.memory:8.0f} MB")
    return [case for case in cases if case.samples and not case.failure]
