# SPDX-License-Identifier: AGPL-3.0-or-later
"""The programs that are compared: how each is called, and how its answer is read.

A job is one call. Its meshes and input files are made before and not charged to any program;
Tetradapt makes its own meshes, unless a job says that it reads the one that all share.
"""
import csv
import dataclasses
import json
import os
import re
import shutil
import subprocess
import sys
from typing import Callable

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
SCENES = os.path.join(ROOT, "prm", "benchmarks")
SYSTEM_PYTHON = "/usr/bin/python3"
# Conjugate gradients to 1e-8 as in the other programs; a mesh alone has no error to stop by.
SOLVE_ONCE = {"Adaptivity/Strategy": "none", "Solver/Stopping": "residual"}


@dataclasses.dataclass
class Job:
    program: str
    case: str
    body: str
    degree: int
    command: list
    folder: str
    parse: Callable

    @property
    def label(self):
        return f"{self.body} {self.program} {self.case} P{self.degree}"


def meshes(output, body, n):
    """The uniform mesh that all programs share; stem of its files, which are made once.

    In a process of its own: a process that starts others must stay small, since Linux counts its
    memory in theirs.
    """
    folder = os.path.join(output, "meshes")
    os.makedirs(folder, exist_ok=True)
    stem = os.path.join(folder, f"{body.name}_{n}")
    if not os.path.exists(stem + ".done"):
        subprocess.run([sys.executable, os.path.join(HERE, "lattice.py"), body.name, str(n), stem],
                       check=True)
    return stem


class Calculix:
    """CalculiX: C3D4 and C3D10."""
    packages = ("calculix-ccx",)

    def __init__(self, solver):
        self.solver = solver
        self.name = "CalculiX " + {"SPOOLES": "SPOOLES", "ITERATIVE SCALING": "CG, scaled",
                                   "ITERATIVE CHOLESKY": "CG, Cholesky"}[solver]

    @staticmethod
    def missing():
        return None if shutil.which("ccx") else "no ccx"

    def job(self, output, body, n, degree):
        stem = meshes(output, body, n)
        folder = os.path.join(output, "calculix")
        os.makedirs(folder, exist_ok=True)
        deck = os.path.join(folder, f"{body.name}_{n}_p{degree}_{self.solver.replace(' ', '_')}")
        if not os.path.exists(deck + ".inp"):
            with open(f"{stem}_p{degree}.inp", encoding="ascii") as source:
                text = source.read().replace("SOLVER=SPOOLES", f"SOLVER={self.solver}")
            with open(deck + ".inp", "w", encoding="ascii") as target:
                target.write(text)
        dofs = body.dofs(n, degree)
        weights = f"{stem}_p{degree}.weights"
        return Job(self.name, f"uniform {n}", body.name, degree, ["ccx", deck], folder,
                   lambda text: {"dofs": dofs, "energy": calculix_energy(deck + ".dat", body, weights)})


def calculix_energy(path, body, weights):
    """a(u,u) from what ccx prints, in seven digits. weights: file of each node's loaded area."""
    with open(path, encoding="ascii") as file:
        numbers = [line.split() for line in file if re.match(r"\s+[-0-9]", line)]
    if body.tractions:
        name, traction = body.tractions[0]
        with open(weights, encoding="ascii") as file:
            areas = json.load(file)[name]
        return sum(areas.get(str(int(row[0]) - 1), 0.) * traction[c] * float(row[1 + c])
                   for row in numbers for c in range(3))
    moved = [(c, value) for _, c, value in body.held if value]
    return sum(float(row[c]) * value for row in numbers for c, value in moved)


class Python:
    """A program that is a Python module with a driver in this folder."""

    def __init__(self, name, module, packages, driver, *options):
        self.name, self.module, self.packages = name, module, packages
        self.driver, self.options = driver, options

    def missing(self):
        if not os.path.exists(SYSTEM_PYTHON):
            return f"no {SYSTEM_PYTHON}"
        code = f"import importlib.util as i, sys; sys.exit(i.find_spec('{self.module}') is None)"
        if os.spawnv(os.P_WAIT, SYSTEM_PYTHON, [SYSTEM_PYTHON, "-c", code]):
            return f"no Python module {self.module}"
        return None

    def job(self, output, body, n, degree, *more):
        stem = meshes(output, body, n)
        command = [SYSTEM_PYTHON, os.path.join(HERE, self.driver), body.name, stem, str(degree),
                   *self.options, *more]
        return Job(self.name, f"uniform {n}", body.name, degree, command, output,
                   lambda text: json.loads(text.strip().splitlines()[-1]))


class Tetradapt:
    """This program. settings: values of parameters that differ from the scene's."""
    packages = ()

    def __init__(self, binary):
        self.binary = binary
        self.name = "Tetradapt"

    def missing(self):
        return None if os.access(self.binary, os.X_OK) else f"no {self.binary}"

    def job(self, output, body, case, degree, settings, ranks=1, scene=None):
        folder = os.path.join(output, "tetradapt", re.sub(r"[^\w.]+", "_", f"{body.name} P{degree} {case}"))
        command = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
        command += [self.binary, os.path.join(SCENES, scene or body.scene), "--output-directory", folder]
        for name, value in {"Degree": degree, **settings}.items():
            command += ["--set", f"{name}={value}"]
        return Job(self.name, case, body.name, degree, command, output,
                   lambda text: read_run(folder))

    def uniform(self, output, body, n, degree, ranks=1):
        """One uniform mesh, solved to 1e-8: bricks made by the program itself, or the file of blocks."""
        if body.name == "cantilever":
            mesh = {"Mesh/Type": "bricks", "Mesh/Size": "", "Mesh/Cells": f"{10 * n}x{n}x{n}"}
        else:
            mesh = self.shared_mesh(output, body, n)
        case = f"uniform {n}" + (f", {ranks} ranks" if ranks > 1 else "")
        return self.job(output, body, case, degree, {**mesh, **SOLVE_ONCE}, ranks)

    def shared(self, output, body, n, degree):
        """The same from the file that all programs share."""
        return self.job(output, body, f"file {n}", degree,
                        {**self.shared_mesh(output, body, n), **SOLVE_ONCE})

    @staticmethod
    def shared_mesh(output, body, n):
        return {"Mesh/Type": "file", "Mesh/Size": "", "Mesh/Files": meshes(output, body, n) + ".msh"}


def read_run(folder):
    """The last cycle of a run, and its seconds by stage."""
    with open(os.path.join(folder, "convergence.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    last = rows[-1]
    energy = 2 * float(last["strain_energy"])
    result = {"dofs": int(last["dofs"]), "tets": int(last["tets"]), "cycles": len(rows),
              "energy": energy, "iterations": int(last["iterations"]),
              "estimate": float(last["relative_estimate"] or "nan")}
    with open(os.path.join(folder, "log.txt"), encoding="utf-8") as file:
        for line in file:
            stage = re.match(r"\s+(\w[\w ]*?)\s{2,}(?:\d+\s+)?([\d.]+)\s+([\d.]+)\s+[\d.]+%$", line)
            if stage:
                result[f"wall_{stage[1]}"], result[f"cpu_{stage[1]}"] = float(stage[2]), float(stage[3])
    return result


def others():
    """All other programs, with each of their solvers."""
    fenicsx = ("dolfinx", ("python3-dolfinx",), "fenicsx_driver.py")
    return [Calculix("SPOOLES"), Calculix("ITERATIVE CHOLESKY"), Calculix("ITERATIVE SCALING"),
            Python("FEniCSx GAMG", *fenicsx, "gamg"), Python("FEniCSx Cholesky", *fenicsx, "cholesky"),
            Python("GetFEM MUMPS", "getfem", ("python3-getfem",), "getfem_driver.py")]
