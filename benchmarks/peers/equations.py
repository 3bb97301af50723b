"""The best equations of motion known for each system, derived by hand, as heyoka's expressions.

Small systems are closed forms; chains are the tridiagonal equations for the rod tensions, which grow linearly with the
number of links; `reduced.py` has systems whose constraints leave fewer numbers than coordinates and velocities.
Differences of angles are kept as arguments of sines and cosines, which costs heyoka less than angle sums do.
"""

from __future__ import annotations

from collections.abc import Callable

import heyoka as hy
from heyoka import expression as Expression

import reduced

G = 9.81


def chain(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Unit masses on unit rods: eliminate the tensions downwards, substitute upwards."""
    count = len(q)
    cos = [hy.cos(q[i + 1] - q[i]) for i in range(count - 1)]
    sin = [hy.sin(q[i + 1] - q[i]) for i in range(count - 1)]
    pivot = [hy.expression(1.0)]
    tension = [v[0] ** 2 + G * hy.cos(q[0])]
    for i in range(1, count):
        factor = cos[i - 1] / pivot[i - 1]
        pivot.append(2.0 - cos[i - 1] * factor)
        tension.append(v[i] ** 2 + factor * tension[i - 1])
    tension[-1] = tension[-1] / pivot[-1]
    for i in reversed(range(count - 1)):
        tension[i] = (tension[i] + cos[i] * tension[i + 1]) / pivot[i]
    accelerations = []
    for i in range(count):
        sideways = -G * hy.sin(q[0]) if i == 0 else -sin[i - 1] * tension[i - 1]
        accelerations.append(sideways + sin[i] * tension[i + 1] if i + 1 < count else sideways)
    return accelerations


def spring(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Mass on a spring that swings."""
    return [
        q[0] * v[1] * v[1] + G * hy.cos(q[1]) - 40.0 * (q[0] - 1.0),
        -(G * hy.sin(q[1]) + 2.0 * v[0] * v[1]) / q[0],
    ]


def henon_heiles(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Hénon–Heiles potential."""
    x, y = q
    return [-x - 2.0 * x * y, -y - x * x + y * y]


def kepler(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Kepler problem: the power is one operation for heyoka."""
    factor = (q[0] ** 2 + q[1] ** 2) ** -1.5
    return [-q[0] * factor, -q[1] * factor]


def pleiades(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Seven stars in a plane: every pair once."""
    pulls: list[list[Expression]] = [[] for _ in range(14)]
    for i in range(7):
        for j in range(i + 1, 7):
            dx, dy = q[j] - q[i], q[7 + j] - q[7 + i]
            factor = hy.sum([dx**2.0, dy**2.0]) ** -1.5
            x, y = factor * dx, factor * dy
            pulls[i].append((j + 1.0) * x)
            pulls[7 + i].append((j + 1.0) * y)
            pulls[j].append(-(i + 1.0) * x)
            pulls[7 + j].append(-(i + 1.0) * y)
    return [hy.sum(pull) for pull in pulls]


def top(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Heavy symmetric top in Euler angles (φ, θ, ψ)."""
    sin, cos = hy.sin(q[1]), hy.cos(q[1])
    spin = v[2] + v[0] * cos
    precession = v[1] * (0.6 * spin - 2.0 * v[0] * cos) / sin
    nutation = sin * (v[0] * v[0] * cos - 0.6 * spin * v[0] + 2.0)
    return [precession, nutation, v[0] * v[1] * sin - precession * cos]


def spherical(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Spherical pendulum (θ, φ), θ from the downward vertical."""
    sin, cos = hy.sin(q[0]), hy.cos(q[0])
    return [sin * (v[1] * v[1] * cos - G), -2.0 * v[0] * v[1] * cos / sin]


def cart(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Cart and pole with damping and a periodic force."""
    mass, length = 0.2, 0.5
    sin, cos = hy.sin(q[1]), hy.cos(q[1])
    on_cart = 2.0 * hy.cos(1.5 * hy.time) - 0.1 * v[0] + mass * length * sin * v[1] * v[1]
    on_pole = mass * G * length * sin - 0.02 * v[1]
    whole, coupling, inertia = 1.0 + mass, mass * length * cos, mass * length * length
    determinant = whole * inertia - coupling * coupling
    return [
        (inertia * on_cart - coupling * on_pole) / determinant,
        (whole * on_pole - coupling * on_cart) / determinant,
    ]


def pendulum(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Cartesian pendulum, the multiplier eliminated."""
    multiplier = -(v[0] ** 2 + v[1] ** 2 - G * q[1]) / (q[0] ** 2 + q[1] ** 2)
    return [multiplier * q[0], multiplier * q[1] - G]


def slider(q: list[Expression], v: list[Expression]) -> list[Expression]:
    """Slider and crank, uniform links of lengths ½ and 1, unit masses, the multiplier eliminated."""
    s1, c1, s2, c2 = hy.sin(q[0]), hy.cos(q[0]), hy.sin(q[1]), hy.cos(q[1])
    square1, square2 = v[0] * v[0], v[1] * v[1]
    cos, sin = c1 * c2 + s1 * s2, s1 * c2 - c1 * s2
    m11 = 1.0 / 12.0 + 0.25 + 0.25 * s1 * s1
    m12 = 0.25 * cos + 0.5 * s1 * s2
    m22 = 1.0 / 3.0 + s2 * s2
    piston = 0.5 * c1 * square1 + c2 * square2
    bias1 = 0.25 * sin * square2 + 0.5 * s1 * piston + 0.75 * G * c1
    bias2 = -0.25 * sin * square1 + s2 * piston + 0.5 * G * c2
    # The constraint gives the second acceleration as ratio · first + rest.
    ratio = -0.5 * c1 / c2
    rest = (0.5 * s1 * square1 + s2 * square2) / c2
    force = bias1 + m12 * rest + ratio * (bias2 + m22 * rest)
    first = -force / (m11 + ratio * (2.0 * m12 + ratio * m22))
    return [first, ratio * first + rest]


SYSTEMS: dict[str, tuple[int, Callable[[list[Expression], list[Expression]], list[Expression]]]] = {
    "dpend": (2, chain),
    "spring": (2, spring),
    "hh": (2, henon_heiles),
    "kepler": (2, kepler),
    "pleiades": (14, pleiades),
    "top": (3, top),
    "sph": (2, spherical),
    "cart": (2, cart),
    "pendc": (2, pendulum),
    "slider": (2, slider),
    "nlink3": (3, chain),
    "nlink5": (5, chain),
    "nlink10": (10, chain),
    "nlink20": (20, chain),
}
NAMES = SYSTEMS.keys() | reduced.SYSTEMS.keys()


def derive(name: str) -> list[tuple[Expression, Expression]]:
    """The first-order system."""
    if name in reduced.SYSTEMS:
        return reduced.derive(name)
    count, accelerations = SYSTEMS[name]
    q = [hy.make_vars(f"q{i}") for i in range(count)]
    v = [hy.make_vars(f"v{i}") for i in range(count)]
    return list(zip(q, v)) + list(zip(v, accelerations(q, v)))
