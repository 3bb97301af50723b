"""Systems with constraints whose best equations are in other numbers than coordinates and velocities.

An expert does not integrate what the constraints already say. The car axis has two degrees of freedom and simple
coordinates for them; the loops of Andrews' mechanism give all its velocities once one is known. The same formulas in
Rust, with more words, are in `../src/systems/car_axis.rs` and `../src/systems/andrews.rs`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import heyoka as hy
import numpy as np
from heyoka import expression as Expression

from problem import Problem, Vector


@dataclass(frozen=True)
class Reduced:
    """First-order equations, and how their numbers belong to a motion."""

    variables: list[Expression]
    slopes: list[Expression]
    # Coordinates and velocities.
    motion: list[Expression]
    # The numbers at the start, from coordinates and velocities there.
    begin: Callable[[Vector], Vector]


def axle() -> tuple[Expression, Expression, Expression]:
    """Cosine and sine of the angle of the axle, and its rate."""
    sin = 0.1 * hy.sin(10.0 * hy.time)
    cos = hy.sqrt(1.0 - sin * sin)
    return cos, sin, hy.cos(10.0 * hy.time) / cos


def car_axis() -> Reduced:
    """Height of the left end above the axle and angle of the rod with it, and their rates."""
    mass, free_length = 5e-4, 0.5
    variables = list(hy.make_vars("height", "lean", "climb", "turn"))
    height, lean, climb, turn = variables
    cosine, sine, rate = axle()
    square = rate * rate
    acceleration = (square - 100.0) * sine / cosine
    sin, cos = hy.sin(lean), hy.cos(lean)
    along, across, whole = cos - 1.0, height + sin, turn + rate
    spring = (free_length * (along * along + across * across) ** -0.5 - 1.0) / mass
    upward = sin * whole * whole + 2.0 * height * square - (height - free_length) / mass
    upward = upward + spring * across - 2.0 * cosine
    around = cos * height * square - sin * (2.0 * climb * rate + height * acceleration)
    around = around + spring * (sin + height * cos) + sin * sine - cos * cosine
    determinant = 1.0 + sin * sin
    slopes = [
        climb,
        turn,
        (upward - cos * around) / determinant,
        (2.0 * around - cos * upward) / determinant - acceleration,
    ]
    # Along the axle and across it: left end, right end, and their rates.
    vectors = [(hy.expression(0.0), height), (cos, across)]
    vectors += [(-height * rate, climb), (-height * rate - sin * whole, climb + cos * whole)]
    motion = [part for x, y in vectors for part in (cosine * x - sine * y, cosine * y + sine * x)]
    return Reduced(variables, slopes, motion, car_axis_begin)


def car_axis_begin(start: Vector) -> Vector:
    """At time zero the axle lies along the first direction and turns with rate one."""
    x0, y0, x1, y1, _, v0, u1, v1 = start
    u0 = start[4]
    cos, sin = x1 - x0, y1 - y0
    return np.array([y0, np.arctan2(sin, cos), v0, cos * (v1 - v0) - sin * (u1 - u0) - 1.0])


@dataclass(frozen=True)
class Pair:
    """Two links that follow a third: l₁ (sin a, −cos a) + l₂ (cos b, sin b) moves as l (sin g, −cos g) does."""

    lengths: tuple[float, float, float]
    # Sine and cosine of a − b, sine of g − b, cosine of g − a.
    sin: Expression
    cos: Expression
    along: Expression
    across: Expression
    # Rates of a and b for that of g.
    first: Expression
    second: Expression

    def rest(self, squares: list[Expression]) -> tuple[Expression, Expression]:
        """Accelerations of a and b when g has none, at these squares of rates of g, a and b."""
        driver, a, b = (length * square for length, square in zip(self.lengths, squares))
        return (
            (a * self.sin + b - driver * self.along) / (self.lengths[1] * self.cos),
            (driver * self.across - a - b * self.sin) / (self.lengths[2] * self.cos),
        )

    def felt(
        self, own: tuple[float, float], coupling: float, squares: list[Expression]
    ) -> tuple[Expression, Expression]:
        """Inertia and torque that the driving link feels; `coupling` sin(a − b) couples the inertias `own`."""
        a, b = self.first, self.second
        c, d = self.rest(squares)
        mixed, bias = coupling * self.sin, coupling * self.cos
        inertia = a * (own[0] * a + 2.0 * mixed * b) + own[1] * b * b
        on_first = bias * squares[2] - own[0] * c - mixed * d
        on_second = -(bias * squares[1]) - own[1] * d - mixed * c
        return inertia, a * on_first + b * on_second


def andrews() -> Reduced:
    """The seven coordinates and the rate of β, which turns γ and σ; γ turns (χ, δ) and (ω, ε)."""
    m = (0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498)
    inertia = (2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5)
    d, da, e, ea, rr, ra, ss = 0.028, 0.0115, 0.02, 0.01421, 0.007, 0.00092, 0.035
    sa, sb, sc, sd, ta, tb = 0.01874, 0.01043, 0.018, 0.02, 0.02308, 0.00916
    u, ua, ub, zf, zt, fa = 0.04, 0.01228, 0.00449, 0.02, 0.04, 0.01421
    stiffness, free_length, motor = 4530.0, 0.07785, 0.033
    j1 = m[0] * ra**2 + m[1] * rr**2 + inertia[0]
    j2 = m[1] * da**2 + inertia[1]
    j3 = m[2] * (sa**2 + sb**2) + inertia[2]
    j4 = m[3] * (e - ea) ** 2 + inertia[3]
    j5 = m[3] * zt**2 + m[4] * (ta**2 + tb**2) + inertia[4]
    j6 = m[5] * (zf - fa) ** 2 + inertia[5]
    j7 = m[5] * u**2 + m[6] * (ua**2 + ub**2) + inertia[6]

    variables = list(hy.make_vars("beta", "theta", "gamma", "phi", "delta", "omega", "epsilon", "rate"))
    beta, theta, gamma, phi, delta, omega, epsilon, rate = variables
    # Quarter turns bring what moves at right angles into the form of a pair.
    swing = beta + theta - gamma
    cos = hy.cos(swing)
    bar = Pair(
        (rr, ss, d),
        -hy.sin(swing),
        cos,
        hy.cos(theta),
        -hy.sin(beta - gamma),
        rr / ss * hy.sin(theta) / cos,
        rr / d * hy.cos(beta - gamma) / cos,
    )
    to_delta, to_chi, cos = gamma - delta, gamma - delta - phi, hy.cos(phi)
    left = Pair(
        (ss, e, zt),
        hy.sin(phi),
        cos,
        hy.sin(to_delta),
        hy.cos(to_chi),
        ss / e * hy.cos(to_delta) / cos,
        ss / zt * hy.sin(to_chi) / cos,
    )
    to_epsilon, to_omega, cos = gamma - epsilon, gamma - epsilon - omega, hy.cos(omega)
    right = Pair(
        (ss, zf, u),
        -hy.sin(omega),
        -cos,
        hy.cos(to_epsilon),
        hy.sin(to_omega),
        ss / zf * hy.sin(to_epsilon) / cos,
        ss / u * hy.cos(to_omega) / cos,
    )

    gamma_rate, sigma_rate = bar.first * rate, bar.second * rate
    chi_rate, delta_rate = left.first * gamma_rate, left.second * gamma_rate
    omega_rate, epsilon_rate = right.first * gamma_rate, right.second * gamma_rate
    rates = (rate, sigma_rate, gamma_rate, chi_rate, delta_rate, omega_rate, epsilon_rate)
    b, s, g, x, y, o, z = (one * one for one in rates)
    velocities = [
        rate,
        sigma_rate - rate,
        gamma_rate,
        chi_rate - delta_rate,
        delta_rate,
        omega_rate - epsilon_rate,
        epsilon_rate,
    ]

    # From the far end of the spring to its bearing, and from there to its near end.
    bx, by = -0.03635 - 0.014, 0.03273 - 0.072
    x_part, y_part = 2.0 * (bx * sd - by * sc), 2.0 * (bx * sc + by * sd)
    sin, cos = hy.sin(gamma), hy.cos(gamma)
    stretch = free_length * (bx**2 + by**2 + sc**2 + sd**2 + x_part * cos + y_part * sin) ** -0.5 - 1.0
    spring = 0.5 * stiffness * stretch * (y_part * cos - x_part * sin)
    left_inertia, left_torque = left.felt((j4, j5), m[3] * zt * (e - ea), [g, x, y])
    right_inertia, right_torque = right.felt((j6, j7), m[5] * u * (zf - fa), [g, o, z])
    outer = j3 + left_inertia + right_inertia

    gamma_rest, sigma_rest = bar.rest([b, g, s])
    sin, cos = m[1] * rr * da * hy.sin(theta), m[1] * rr * da * hy.cos(theta)
    whole = j1 + bar.second * (j2 * bar.second - 2.0 * cos) + bar.first * bar.first * outer
    torque = motor + cos * sigma_rest - sin * s + bar.second * (sin * b - j2 * sigma_rest)
    torque = torque + bar.first * (spring + left_torque + right_torque - outer * gamma_rest)
    return Reduced(variables, [*velocities, torque / whole], [*variables[:7], *velocities], lambda y: y[:8])


SYSTEMS: dict[str, Callable[[], Reduced]] = {"andrews": andrews, "caraxis": car_axis}


def derive(name: str) -> list[tuple[Expression, Expression]]:
    """The first-order system."""
    system = SYSTEMS[name]()
    return list(zip(system.variables, system.slopes))


def begin(problem: Problem) -> Vector:
    """What the integration starts from; coordinates and velocities where nothing was reduced."""
    if problem.name not in SYSTEMS:
        return problem.start
    return SYSTEMS[problem.name]().begin(problem.start)


@cache
def restorer(name: str) -> hy.cfunc_dbl:
    """Evaluates coordinates and velocities."""
    system = SYSTEMS[name]()
    return hy.cfunc(system.motion, system.variables)


def end(problem: Problem, found: Vector) -> Vector:
    """Coordinates and velocities where the integration arrived."""
    if problem.name not in SYSTEMS:
        return found
    return restorer(problem.name)(found, time=problem.t_end)
