"""The cases as modes that an expert would write by hand: smooth equations, the guard that ends a mode, what follows.

A state is (x, v), `p` the number that tells the mode. `m` is the module of functions: heyoka's or Python's own.
The mode ends where its guard falls through zero.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

G = 9.81
# Coulomb oscillator: mass, stiffness, friction force.
MASS, STIFFNESS, FRICTION = 2.0, 50.0, 0.25 * 2.0 * G
# Belt: force that sticks, force that slips. Its speed is that of the block at the start.
STATIC, KINETIC = 4.0, 2.4
# Rocking block: half diagonal, its angle, 3 g / 4 r, what an impact leaves of the rate.
HALF = (0.2, 0.5)
RADIUS, ALPHA = math.hypot(*HALF), math.atan2(*HALF)
SQUARE = 3.0 * G / (4.0 * RADIUS)
LEFT = 1.0 - 1.5 * math.sin(ALPHA) ** 2
# Hoop: radius, coefficient of friction.
HOOP, ROUGH = 0.5, 0.2

State = list[float]


@dataclass(frozen=True)
class Case:
    """A system in modes."""

    mode: float
    slope: Callable[[Any, Any, Any, Any], Any]
    guard: Callable[[Any, Any, Any], Any]
    after: Callable[[State, float], tuple[State, float]]


def _coulomb(s: State, p: float) -> tuple[State, float]:
    held = abs(STIFFNESS * s[0]) <= FRICTION
    return [s[0], 0.0], 0.0 if held else -p


def _hoop(s: State, p: float) -> tuple[State, float]:
    return [s[0], 0.0], 0.0 if math.tan(abs(s[0])) <= ROUGH else -p


CASES = {
    "ball": Case(1.0, lambda m, x, v, p: -G + 0.0 * x, lambda x, v, p: x, lambda s, p: ([s[0], -0.8 * s[1]], p)),
    "wall": Case(
        1.0,
        lambda m, x, v, p: -G / 0.8 * m.sin(x),
        lambda x, v, p: x,
        lambda s, p: ([s[0], -0.9 * s[1]], p),
    ),
    # p is the direction of the slip, zero at rest, where the guard stays at one.
    "coulomb": Case(
        -1.0,
        lambda m, x, v, p: p * p * (-STIFFNESS * x - p * FRICTION) / MASS,
        lambda x, v, p: p * v + (1.0 - p * p),
        _coulomb,
    ),
    "block": Case(
        1.0,
        lambda m, x, v, p: -SQUARE * m.sin(p * ALPHA - x),
        lambda x, v, p: p * x,
        lambda s, p: ([s[0], LEFT * s[1]], -p),
    ),
    "hoop": Case(
        -1.0,
        lambda m, x, v, p: p * p * (-G / HOOP * m.sin(x) - p * ROUGH * (v * v + G / HOOP * m.cos(x))),
        lambda x, v, p: p * v + (1.0 - p * p),
        _hoop,
    ),
    "bilinear": Case(1.0, lambda m, x, v, p: -(6.5 - 2.5 * p) * x, lambda x, v, p: p * x, lambda s, p: (s, -p)),
    "valley": Case(1.0, lambda m, x, v, p: -p + 0.0 * x, lambda x, v, p: p * x, lambda s, p: (s, -p)),
}


def belt(speed: float) -> Case:
    """A block at rest on a belt of this speed: p is one while it slips, zero while it sticks."""
    return Case(
        0.0,
        lambda m, x, v, p: p * (KINETIC - 9.0 * x),
        lambda x, v, p: p * (speed - v) + (1.0 - p) * (STATIC - 9.0 * x),
        lambda s, p: (s, 1.0) if p == 0.0 else ([s[0], speed], 0.0),
    )


def case(name: str, start: Sequence[float]) -> Case | None:
    """The case of a name, for a start."""
    return belt(start[1]) if name == "belt" else CASES.get(name)
