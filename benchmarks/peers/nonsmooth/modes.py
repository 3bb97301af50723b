"""heyoka and SciPy on modes that are written and switched by hand (`cases.py`)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from cases import Case, case
from problem import Failure, Integrator, Problem, Subject, Vector

# Fewer steps than any run should need.
STEPS = 1_000_000


class Heyoka(Integrator):
    """One terminal event that ends the mode; its callback changes the state and the parameter of the mode."""

    def __init__(self, problem: Problem, case: Case, tolerance: float) -> None:
        import heyoka as hy

        self.problem, self.case = problem, case
        x, v = hy.make_vars("x", "v")
        p = hy.par[0]

        def fired(integrator: Any, _: int) -> bool:
            mode = integrator.pars[0] if self.modes else case.mode
            state, mode = case.after(list(integrator.state), mode)
            integrator.state[:] = state
            if self.modes:
                integrator.pars[0] = mode
            return True

        guard = hy.expression(0.0) + case.guard(x, v, p)
        event = hy.t_event(guard, callback=fired, direction=hy.event_direction.negative)
        # A mode in which nothing moves: every slope is multiplied by the mode where there is one.
        moves = p * p if case.mode < 0.0 else hy.expression(1.0)
        slope = [(x, moves * v), (v, case.slope(hy, x, v, p))]
        # Parameters that no equation names are refused.
        named = hy.get_params([slope[0][1], slope[1][1], guard])
        self.modes = [case.mode] if named else []
        self.integrator = hy.taylor_adaptive(
            slope, list(problem.start), pars=self.modes, tol=tolerance, t_events=[event]
        )
        self.outcome = hy.taylor_outcome.time_limit
        self.taken = 0

    def reset(self) -> None:
        self.integrator.time = 0.0
        self.integrator.state[:] = self.problem.start
        self.integrator.pars[:] = self.modes
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

    def __init__(self, problem: Problem, case: Case, tolerance: float) -> None:
        self.problem, self.case = problem, case
        # It refuses smaller ones.
        self.tolerance = max(tolerance, 2.3e-14)
        self.end = np.array(problem.start)
        self.count = 0

    def reset(self) -> None:
        self.count = 0

    def run(self) -> None:
        from scipy.integrate import solve_ivp

        case, end = self.case, self.problem.t_end
        t, state, p = 0.0, list(self.problem.start), case.mode
        while t < end and not (case.mode < 0.0 and p == 0.0):
            guard = lambda _, s, p=p: case.guard(s[0], s[1], p)
            guard.terminal, guard.direction = True, -1.0
            found = solve_ivp(
                lambda _, s, p=p: [s[1], case.slope(math, s[0], s[1], p)],
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
                state, p = case.after(state, p)
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
        return self.kind(problem, case(problem.name, problem.start), tolerance)


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
