"""numbalsoda: DOP853 and LSODA in native code, on hand-written accelerations compiled by gcc.

Chains are the tridiagonal equations for the rod tensions; systems with constraints are reduced by hand.
"""

from __future__ import annotations

import ctypes
import hashlib
import subprocess
from collections.abc import Callable
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np

import reduced
from problem import Failure, Integrator, Problem, Subject, Vector

try:
    import numbalsoda
except ImportError:
    numbalsoda = None

HERE = Path(__file__).resolve().parent
FLAGS = ["-O3", "-march=native", "-fno-math-errno", "-shared", "-fPIC"]


def library() -> ctypes.CDLL:
    """The accelerations, compiled on demand."""
    source = HERE / "hand.c"
    text = source.read_bytes() + " ".join(FLAGS).encode()
    built = HERE / ".venv" / f"hand-{hashlib.sha256(text).hexdigest()[:12]}.so"
    if not built.exists():
        subprocess.run(["gcc", *FLAGS, str(source), "-o", str(built), "-lm"], check=True)
    return ctypes.CDLL(str(built))


class Run(Integrator):
    """One integration by a function of numbalsoda."""

    def __init__(
        self, solve: Callable[..., Any], field: int | None, problem: Problem, tolerance: float
    ) -> None:
        self.solve = solve
        self.field = field
        self.problem = problem
        self.tolerance = tolerance
        self.times = np.array([0.0, problem.t_end])
        self.start = reduced.begin(problem)
        self.end = self.start

    def reset(self) -> None:
        pass

    def run(self) -> None:
        tolerances = {"rtol": self.tolerance, "atol": self.tolerance}
        states, success = self.solve(
            self.field, self.start, self.times, mxstep=2_000_000, **tolerances
        )
        if not success:
            raise Failure("no success")
        self.end = states[-1]

    def ends(self) -> list[Vector]:
        return [reduced.end(self.problem, self.end)]

    def steps(self) -> int:
        return 0


class Numbalsoda(Subject):
    """One of its methods."""

    def __init__(self, method: str, solve: Callable[..., Any], field: ctypes.CDLL) -> None:
        self.name = f"numbalsoda-{method}"
        self.solve = solve
        self.library = field

    def build(self, problem: Problem, tolerance: float) -> Integrator:
        field = ctypes.cast(getattr(self.library, problem.name), ctypes.c_void_p).value
        return Run(self.solve, field, problem, tolerance)


def subjects() -> list[Subject]:
    """Its methods, if it is installed."""
    if numbalsoda is None:
        return []
    fields = library()
    return [
        Numbalsoda("dop853", numbalsoda.dop853, fields),
        Numbalsoda("lsoda", numbalsoda.lsoda, fields),
    ]


def versions() -> dict[str, str]:
    """What was measured."""
    return {} if numbalsoda is None else {"numbalsoda": metadata.version("numbalsoda")}
