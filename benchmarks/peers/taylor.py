"""heyoka: Taylor series, compiled at run time for the present processor.

`heyoka-lagrangian` takes what its symbolic `lagrangian()` derives, `heyoka-expert` the best equations known, derived by
hand; `-fast` allows its compiler to reorder floating-point operations, which is off by default. The default mode
writes the whole recurrence out and is the faster one; the compact mode, which builds in seconds where the default
mode would take minutes, serves the few cases named below. In batch mode the lanes hold the same trajectory, which is
the most favourable case; times are for each trajectory. What an empty call costs from Python is subtracted.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import heyoka as hy
import numpy as np

import equations
import lagrangians
import reduced
from problem import Failure, Integrator, Problem, Subject, Vector

# Where the default mode takes more than about ten seconds to build, or is the slower one.
COMPACT = {
    ("lagrangian", 1): {"nlink10", "nlink20"},
    ("lagrangian", 4): {"nlink10", "nlink20"},
    ("lagrangian", 8): {"nlink10", "nlink20", "pleiades"},
}
# Empty calls that are timed.
CALLS = 101


def call(propagate: Callable[[], object]) -> float:
    """Time of a call that has nowhere to go [s]."""
    times = []
    for _ in range(CALLS):
        start = time.perf_counter()
        propagate()
        times.append(time.perf_counter() - start)
    return min(times)


class Scalar(Integrator):
    """One trajectory."""

    def __init__(self, problem: Problem, integrator: hy.taylor_adaptive_dbl) -> None:
        self.problem = problem
        self.start = reduced.begin(problem)
        self.integrator = integrator
        self.taken = 0
        self.overhead = call(lambda: integrator.propagate_until(0.0))

    def reset(self) -> None:
        self.integrator.time = 0.0
        self.integrator.state[:] = self.start

    def run(self) -> None:
        outcome, _, _, self.taken, *_ = self.integrator.propagate_until(self.problem.t_end)
        if outcome != hy.taylor_outcome.time_limit:
            raise Failure(str(outcome))

    def ends(self) -> list[Vector]:
        return [reduced.end(self.problem, self.integrator.state.copy())]

    def steps(self) -> int:
        return int(self.taken)


class Batch(Integrator):
    """The same trajectory in every lane."""

    def __init__(self, problem: Problem, integrator: hy.taylor_adaptive_batch_dbl, lanes: int) -> None:
        self.integrator = integrator
        self.trajectories = lanes
        self.zero = np.zeros(lanes)
        self.target = np.full(lanes, problem.t_end)
        self.problem = problem
        self.start = np.repeat(reduced.begin(problem)[:, None], lanes, axis=1)
        self.overhead = call(lambda: integrator.propagate_until(self.zero))

    def reset(self) -> None:
        self.integrator.set_time(self.zero)
        self.integrator.state[:] = self.start

    def run(self) -> None:
        self.integrator.propagate_until(self.target)

    def ends(self) -> list[Vector]:
        states = (self.integrator.state[:, lane].copy() for lane in range(self.trajectories))
        return [reduced.end(self.problem, state) for state in states]

    def steps(self) -> int:
        return int(self.integrator.propagate_res[0][3])


class Heyoka(Subject):
    """One source of equations, one batch size, one kind of arithmetic."""

    def __init__(self, source: str, lanes: int, fast: bool) -> None:
        self.source = source
        self.lanes = lanes
        self.fast = fast
        self.name = f"heyoka-{source}" + (f"-batch{lanes}" if lanes > 1 else "") + ("-fast" if fast else "")
        self.derived: dict[str, list[tuple[hy.expression, hy.expression]]] = {}

    def systems(self, names: dict[str, Problem]) -> list[str]:
        # Its lagrangian() knows no constraints.
        known = lagrangians.SYSTEMS.keys() if self.source == "lagrangian" else equations.NAMES
        return [name for name in names if name in known]

    def build(self, problem: Problem, tolerance: float) -> Integrator:
        name = problem.name
        if name not in self.derived:
            derive = lagrangians.derive if self.source == "lagrangian" else equations.derive
            self.derived[name] = derive(name)
        compact = name in COMPACT.get((self.source, self.lanes), set())
        options = {"tol": tolerance, "compact_mode": compact, "fast_math": self.fast}
        start = reduced.begin(problem)
        if self.lanes == 1:
            return Scalar(problem, hy.taylor_adaptive(self.derived[name], start.copy(), **options))
        start = np.repeat(start[:, None], self.lanes, axis=1)
        return Batch(problem, hy.taylor_adaptive_batch(self.derived[name], start, **options), self.lanes)


def subjects() -> list[Subject]:
    """Everything that heyoka offers, on one thread."""
    hy.set_nthreads(1)
    kinds = [(1, False), (1, True), (4, False), (8, False)]
    return [Heyoka(source, lanes, fast) for lanes, fast in kinds for source in ("lagrangian", "expert")]


def versions() -> dict[str, str]:
    """What was measured."""
    return {"heyoka": hy.__version__}
