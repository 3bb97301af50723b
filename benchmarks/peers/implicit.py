"""CasADi: SUNDIALS on equations that CasADi derives from energies and constraints.

`casadi-idas` keeps the multipliers as algebraic variables (index 1: constraints differentiated twice, accelerations
eliminated, a consistent start), `casadi-cvodes` eliminates them too and integrates by Adams' methods. What CasADi would
interpret is compiled by gcc instead. No better in trials: accelerations as algebraic variables, multipliers out of the
error test, Baumgarte's terms, and the stabilised form of index 2.
"""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from problem import Failure, Integrator, Problem, Subject, Vector

try:
    import casadi as ca
except ImportError:
    ca = None

G = 9.81
STEPS = 300_000
FLAGS = ["-O3", "-march=native"]


@dataclass(frozen=True)
class System:
    """L, generalised forces and constraints of coordinates and velocities, and of time."""

    time: ca.SX
    q: ca.SX
    v: ca.SX
    lagrangian: ca.SX
    forces: ca.SX
    constraints: ca.SX

    def multipliers(self) -> tuple[ca.SX, ca.SX, ca.SX]:
        """The multipliers, accelerations as functions of them, and what they have to make zero."""
        momenta = ca.gradient(self.lagrangian, self.v)
        inertia = ca.jacobian(momenta, self.v)
        torques = self.forces + ca.gradient(self.lagrangian, self.q) - self.change(momenta)
        slopes = ca.jacobian(self.constraints, self.q)
        unknown = ca.SX.sym("multipliers", self.constraints.numel())
        accelerations = ca.solve(inertia, torques + ca.mtimes(slopes.T, unknown))
        residuals = ca.mtimes(slopes, accelerations) + self.change(self.change(self.constraints))
        return unknown, accelerations, residuals

    def change(self, value: ca.SX) -> ca.SX:
        """Time derivative at constant velocities."""
        return ca.jtimes(value, self.q, self.v) + ca.jacobian(value, self.time)


def symbols(count: int) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Time, coordinates and velocities."""
    return ca.SX.sym("t"), ca.SX.sym("q", count), ca.SX.sym("v", count)


def turned(angle: ca.SX, x: float, y: float) -> ca.SX:
    """A vector that turns with a body."""
    sin, cos = ca.sin(angle), ca.cos(angle)
    return ca.vertcat(cos * x - sin * y, sin * x + cos * y)


def energy(q: ca.SX, v: ca.SX, mass: float, place: ca.SX) -> ca.SX:
    """Kinetic energy of a mass at a place."""
    return 0.5 * mass * ca.sumsqr(ca.jtimes(place, q, v))


def pendulum() -> System:
    """Cartesian pendulum."""
    t, q, v = symbols(2)
    return System(t, q, v, 0.5 * ca.sumsqr(v) - G * q[1], ca.SX(2, 1), 0.5 * (ca.sumsqr(q) - 1.0))


def slider() -> System:
    """Slider and crank, uniform links of lengths ½ and 1, unit masses."""
    t, q, v = symbols(2)
    crank, rod = turned(q[0], 0.25, 0.0), turned(q[0], 0.5, 0.0) + turned(q[1], 0.5, 0.0)
    piston = turned(q[0], 0.5, 0.0) + turned(q[1], 1.0, 0.0)
    kinetic = energy(q, v, 1.0, crank) + energy(q, v, 1.0, rod) + energy(q, v, 1.0, piston[0])
    kinetic += v[0] ** 2 / 96.0 + v[1] ** 2 / 24.0
    return System(t, q, v, kinetic - G * (crank[1] + rod[1]), ca.SX(2, 1), piston[1])


def car_axis() -> System:
    """Rod between two wheels on springs, one of which runs over a wavy road."""
    t, q, v = symbols(4)
    mass, left, right = 5e-4, q[:2], q[2:]
    wave = 0.1 * ca.sin(10.0 * t)
    axle = ca.vertcat(ca.sqrt(1.0 - wave**2), wave)
    springs = (ca.norm_2(left) - 0.5) ** 2 + (ca.norm_2(right - axle) - 0.5) ** 2
    lagrangian = 0.5 * mass * ca.sumsqr(v) - 0.5 * springs - mass * (left[1] + right[1])
    constraints = ca.vertcat(ca.dot(axle, left), ca.sumsqr(left - right) - 1.0)
    return System(t, q, v, lagrangian, ca.SX(4, 1), constraints)


def andrews() -> System:
    """Andrews' squeezing mechanism."""
    t, q, v = symbols(7)
    beta, theta, gamma, phi, delta, omega, epsilon = (q[i] for i in range(7))
    sigma, chi, psi = beta + theta, phi + delta, omega + epsilon
    a, b, c = ca.DM([-0.06934, -0.00227]), ca.DM([-0.03635, 0.03273]), ca.DM([0.014, 0.072])
    bodies = [
        (0.04325, 2.194e-6, beta, turned(beta, 0.00092, 0.0)),
        (0.00365, 4.410e-7, sigma, turned(beta, 0.007, 0.0) - turned(sigma, 0.0115, 0.0)),
        (0.02373, 5.255e-6, gamma, b + turned(gamma, 0.01043, -0.01874)),
        (0.00706, 5.667e-7, chi, a + turned(delta, 0.04, 0.0) + turned(chi, 0.0, 0.01421 - 0.02)),
        (0.07050, 1.169e-5, delta, a + turned(delta, 0.02308, 0.00916)),
        (0.00706, 5.667e-7, psi, a + turned(epsilon, 0.0, -0.04) + turned(psi, 0.02 - 0.01421, 0.0)),
        (0.05498, 1.912e-5, epsilon, a + turned(epsilon, -0.00449, -0.01228)),
    ]
    kinetic = sum(
        energy(q, v, mass, place) + 0.5 * inertia * ca.jtimes(angle, q, v) ** 2
        for mass, inertia, angle, place in bodies
    )
    spring = ca.norm_2(b + turned(gamma, 0.02, -0.018) - c)
    pin = turned(beta, 0.007, 0.0) - turned(sigma, 0.028, 0.0)
    constraints = ca.vertcat(
        pin - turned(gamma, 0.0, -0.035) - b,
        pin - turned(chi, 0.0, -0.02) - turned(delta, 0.04, 0.0) - a,
        pin - turned(psi, 0.02, 0.0) - turned(epsilon, 0.0, -0.04) - a,
    )
    motor = ca.vertcat(0.033, ca.SX(6, 1))
    return System(t, q, v, kinetic - 0.5 * 4530.0 * (spring - 0.07785) ** 2, motor, constraints)


SYSTEMS: dict[str, Callable[[], System]] = {
    "pendc": pendulum,
    "slider": slider,
    "andrews": andrews,
    "caraxis": car_axis,
}


class Run(Integrator):
    """One integration."""

    def __init__(self, integrator: ca.Function, start: dict[str, Vector]) -> None:
        self.integrator = integrator
        self.start = start
        self.end = start["x0"]

    def reset(self) -> None:
        pass

    def run(self) -> None:
        try:
            self.end = self.integrator(**self.start)["xf"]
        except RuntimeError as error:
            raise Failure(str(error).strip().rpartition("\n")[2]) from error

    def ends(self) -> list[Vector]:
        return [np.array(self.end).ravel()]

    def steps(self) -> int:
        return int(self.integrator.stats()["nsteps"])


class Sundials(Subject):
    """One of its integrators."""

    def __init__(self, plugin: str) -> None:
        self.name = f"casadi-{plugin}"
        self.plugin = plugin
        # For compiled functions; nothing else decides where CasADi puts them, nor removes them in time.
        self.directory = tempfile.TemporaryDirectory(prefix="peers-")

    def systems(self, names: dict[str, Problem]) -> list[str]:
        return [name for name in names if name in SYSTEMS]

    def build(self, problem: Problem, tolerance: float) -> Integrator:
        system = SYSTEMS[problem.name]()
        unknown, accelerations, residuals = system.multipliers()
        state = ca.vertcat(system.q, system.v)
        matrix, rest = ca.linear_coeff(residuals, unknown)
        solved = -ca.solve(matrix, rest)
        equations = {"t": system.time, "x": state}
        start = {"x0": problem.start}
        options = {"abstol": tolerance, "reltol": tolerance, "max_num_steps": STEPS}
        if self.plugin == "idas":
            equations |= {"z": unknown, "ode": ca.vertcat(system.v, accelerations), "alg": residuals}
            start["z0"] = np.array(ca.Function("start", [system.time, state], [solved])(0.0, problem.start))
        else:
            eliminated = ca.substitute(accelerations, unknown, solved)
            equations |= {"ode": ca.vertcat(system.v, eliminated)}
            options |= {"linear_multistep_method": "adams", "nonlinear_solver_iteration": "functional"}
        compilation = {"flags": FLAGS, "cleanup": False}
        options |= {"jit": True, "jit_cleanup": False, "compiler": "shell", "jit_options": compilation}
        with contextlib.chdir(self.directory.name):
            integrator = ca.integrator("run", self.plugin, equations, 0.0, problem.t_end, options)
        return Run(integrator, start)


def subjects() -> list[Subject]:
    """Its integrators, if it is installed."""
    return [] if ca is None else [Sundials("idas"), Sundials("cvodes")]


def versions() -> dict[str, str]:
    """What was measured."""
    return {} if ca is None else {"CasADi": ca.__version__}
