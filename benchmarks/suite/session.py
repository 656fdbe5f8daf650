# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the experiments share: where to write, which programs there are, tables."""
import csv
import os
import platform
import re
import subprocess
import sys
import time

from suite import measure, programs
from suite.bodies import BODIES


class Session:
    """output: folder of tables and plots; quick: small meshes, few runs."""

    def __init__(self, output, binary, quick):
        self.output, self.quick = output, quick
        os.makedirs(output, exist_ok=True)
        self.begin = time.monotonic()
        self.tetradapt = programs.Tetradapt(binary)
        reason = self.tetradapt.missing()
        if reason:
            sys.exit(f"There is no program to measure: {reason}")
        self.others = []
        for program in programs.others():
            reason = program.missing()
            if reason:
                self.say(f"left out: {program.name} ({reason}; benchmarks/run --install installs it)")
            else:
                self.others.append(program)
        self.compiled = False

    def compile_forms(self):
        """FEniCSx compiles each form once and keeps it, which is not to be measured."""
        program = next(p for p in self.others if p.name == "FEniCSx GAMG")
        self.say("  FEniCSx compiles its forms")
        for body in BODIES.values():
            for degree in (1, 2):
                measure.run(program.job(self.output, body, 2, degree))
        self.compiled = True

    def say(self, text):
        print(f"[{time.monotonic() - self.begin:6.0f} s] {text}", flush=True)

    def measure(self, jobs, repeats=None, spend=None, warm=False):
        """See measure.measure(); quick sessions run everything once or twice."""
        repeats = repeats or (2 if self.quick else 3)
        spend = spend or (8 if self.quick else 30)
        if not self.compiled and any(job.program.startswith("FEniCSx") for job in jobs):
            self.compile_forms()
        return measure.measure(jobs, repeats, spend, self.say, warm)

    def path(self, name):
        return os.path.join(self.output, name)

    def write(self, name, rows):
        """A table: rows are dicts; columns in the order of their first appearance."""
        columns = list(dict.fromkeys(key for row in rows for key in row))
        with open(self.path(name + ".csv"), "w", newline="", encoding="utf-8") as file:
            table = csv.DictWriter(file, columns, lineterminator="\n", restval="")
            table.writeheader()
            table.writerows(rows)

    def read(self, name):
        """The rows of a table, or none if it was not made."""
        try:
            with open(self.path(name + ".csv"), newline="", encoding="utf-8") as file:
                return list(csv.DictReader(file))
        except FileNotFoundError:
            return []

    def machine(self):
        """One line: processor, system, versions."""
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            model = re.search(r"model name\s*:\s*(.*)", file.read())
        version = subprocess.run([self.tetradapt.binary, "--version"], stdout=subprocess.PIPE,
                                 text=True, check=False).stdout
        version = ", ".join(" ".join(line.split()) for line in version.strip().splitlines())
        system = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
        return (f"{model[1].strip() if model else platform.machine()}, {os.cpu_count()} processors, "
                f"{system}. {version}.")
