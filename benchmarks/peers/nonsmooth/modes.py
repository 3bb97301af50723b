"""heyoka and SciPy on modes that are written and switched by hand (`cases.py`)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from cases import case
from problem import Failure, Integrator, Problem, Subject, Vector

# Fewer steps than any run should need.
STEPS = 1_000_000


class Heyoka(Integrator):
    """One terminal event that ends the mode; its callback changes the state and the parameter of the mode.

    What the case takes from its start is a second parameter, so that one integrator serves all starts.
    """

    def __init__(self, problem: Problem, tolerance: float) -> None:
        import heyoka as hy

        self.problem = problem
        mode = case(problem.name, problem.start).mode
        form = case(problem.name, [hy.par[1], hy.par[1]])
        x, v = hy.make_vars("x", "v")
        p = hy.par[0]

        def fired(integrator: Any, _: int) -> bool:
            now = integrator.pars[0] if self.count > 0 else mode
            state, now = self.case.after(list(integrator.state), now)
            integrator.state[:] = state
            if self.count > 0:
                integrator.pars[0] = now
            return True

        guard = hy.expression(0.0) + form.guard(x, v, p)
        event = hy.t_event(guard, callback=fired, direction=hy.event_direction.negative)
        # A mode in which nothing moves: every slope is multiplied by the mode where there is one.
        moves = p * p if mode < 0.0 else hy.expression(1.0)
        slope = [(x, moves * v), (v, form.slope(hy, x, v, p))]
        # Parameters that no equation names are refused.
        self.count = len(hy.get_params([slope[0][1], slope[1][1], guard]))
        self.integrator = hy.taylor_adaptive(
            slope, list(problem.start), pars=[mode, 0.0][: self.count], tol=tolerance, t_events=[event]
        )
        self.mode, self.outcome = mode, hy.taylor_outcome.time_limit
        self.taken = 0
        self.reset()

    def reset(self) -> None:
        start = self.problem.start
        self.case = case(self.problem.name, start)
        self.integrator.time = 0.0
        self.integrator.state[:] = start
        self.integrator.pars[:] = [self.mode, start[1]][: self.count]
        self.integrator.reset_cooldowns()

    def run(self) -> None:
        found = self.integrator.propagate_until(self.problem.t_end, max_steps=STEPS)
        self.taken = found[3]
        if found[0] != self.outcome:
            raise Failure(str(found[0]))

    def ends(self) -> list[Vector]:
        return [self.integrator.state.copy()]

    def steps(self) -> int:
        return int(self.taken)


class Scipy(Integrator):
    """`solve_ivp` from event to event, by DOP853."""

    def __init__(self, problem: Problem, tolerance: float) -> None:
        self.problem = problem
        # It refuses smaller ones.
        self.tolerance = max(tolerance, 2.3e-14)
        self.end = np.array(problem.start)
        self.count = 0

    def reset(self) -> None:
        self.count = 0

    def run(self) -> None:
        from scipy.integrate import solve_ivp

        end, modes = self.problem.t_end, case(self.problem.name, self.problem.start)
        t, state, p = 0.0, list(self.problem.start), modes.mode
        while t < end and not (modes.mode < 0.0 and p == 0.0):
            guard = lambda _, s, p=p: modes.guard(s[0], s[1], p)
            guard.terminal, guard.direction = True, -1.0
            found = solve_ivp(
                lambda _, s, p=p: [s[1], modes.slope(math, s[0], s[1], p)],
                (t, end),
                state,
                method="DOP853",
                rtol=self.tolerance,
                atol=self.tolerance,
                events=guard,
            )
            self.count += found.nfev
            if self.count > STEPS or not found.success:
                raise Failure("does not end")
            t, state = found.t[-1], list(found.y[:, -1])
            if found.status == 1:
                state, p = modes.after(state, p)
        self.end = np.array(state)

    def ends(self) -> list[Vector]:
        return [self.end]

    def steps(self) -> int:
        return self.count


class Modes(Subject):
    """One of these integrators."""

    def __init__(self, name: str, kind: type) -> None:
        self.name, self.kind = name, kind

    def systems(self, names: dict[str, Problem]) -> list[str]:
        return [name for name, problem in names.items() if case(name, problem.start)]

    def build(self, problem: Problem, tolerance: float) -> Integrator:
        return self.kind(problem, tolerance)


def offers() -> tuple[list[Subject], dict[str, str]]:
    """What is installed, and its versions."""
    subjects: list[Subject] = []
    versions: dict[str, str] = {}
    try:
        import heyoka

        heyoka.set_nthreads(1)
        subjects.append(Modes("heyoka", Heyoka))
        versions["heyoka"] = heyoka.__version__
    except ImportError:
        pass
    try:
        import scipy

        subjects.append(Modes("scipy-dop853", Scipy))
        versions["SciPy"] = scipy.__version__
    except ImportError:
        pass
    return subjects, versions
