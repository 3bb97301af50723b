"""The systems as a user of heyoka's `lagrangian()` writes them."""

from __future__ import annotations

from collections.abc import Callable

import heyoka as hy
from heyoka import expression as Expression

G = 9.81


def chain(q: list[Expression], v: list[Expression]) -> Expression:
    """Unit masses on unit rods, absolute angles; the double pendulum is the chain of two."""
    count = len(q)
    energy = 0.0
    for i in range(count):
        hanging = float(count - i)
        energy = energy + 0.5 * hanging * v[i] * v[i] + hanging * G * hy.cos(q[i])
        for j in range(i):
            energy = energy + hanging * hy.cos(q[i] - q[j]) * v[i] * v[j]
    return energy


def spring(q: list[Expression], v: list[Expression]) -> Expression:
    """Mass on a spring that swings."""
    kinetic = 0.5 * (v[0] * v[0] + q[0] * q[0] * v[1] * v[1])
    return kinetic + G * q[0] * hy.cos(q[1]) - 20.0 * (q[0] - 1.0) * (q[0] - 1.0)


def henon_heiles(q: list[Expression], v: list[Expression]) -> Expression:
    """Hénon–Heiles potential."""
    x, y = q
    kinetic = 0.5 * (v[0] * v[0] + v[1] * v[1])
    return kinetic - 0.5 * (x * x + y * y) - x * x * y + y * y * y / 3.0


def kepler(q: list[Expression], v: list[Expression]) -> Expression:
    """Kepler problem, μ = 1."""
    return 0.5 * (v[0] * v[0] + v[1] * v[1]) + 1.0 / hy.sqrt(q[0] * q[0] + q[1] * q[1])


def pleiades(q: list[Expression], v: list[Expression]) -> Expression:
    """Seven stars in a plane with masses 1 to 7; first all x, then all y."""
    energy = 0.0
    for i in range(7):
        energy = energy + 0.5 * (i + 1.0) * (v[i] * v[i] + v[7 + i] * v[7 + i])
        for j in range(i + 1, 7):
            dx, dy = q[i] - q[j], q[7 + i] - q[7 + j]
            energy = energy + (i + 1.0) * (j + 1.0) / hy.sqrt(dx * dx + dy * dy)
    return energy


def top(q: list[Expression], v: list[Expression]) -> Expression:
    """Heavy symmetric top in Euler angles (φ, θ, ψ)."""
    sin, cos = hy.sin(q[1]), hy.cos(q[1])
    spin = v[2] + v[0] * cos
    return 0.5 * (v[1] * v[1] + v[0] * v[0] * sin * sin) + 0.3 * spin * spin - 2.0 * cos


def spherical(q: list[Expression], v: list[Expression]) -> Expression:
    """Spherical pendulum (θ, φ), θ from the downward vertical."""
    sin = hy.sin(q[0])
    return 0.5 * (v[0] * v[0] + sin * sin * v[1] * v[1]) + G * hy.cos(q[0])


def cart(q: list[Expression], v: list[Expression]) -> Expression:
    """Cart and pole; the periodic force enters as a potential that is linear in the position."""
    kinetic = 0.6 * v[0] * v[0] + 0.1 * hy.cos(q[1]) * v[0] * v[1] + 0.025 * v[1] * v[1]
    return kinetic - 0.1 * G * hy.cos(q[1]) + 2.0 * hy.cos(1.5 * hy.time) * q[0]


def cart_dissipation(v: list[Expression]) -> Expression:
    """Rayleigh's function of the cart and pole."""
    return 0.05 * v[0] * v[0] + 0.01 * v[1] * v[1]


SYSTEMS: dict[str, tuple[int, Callable[[list[Expression], list[Expression]], Expression]]] = {
    "dpend": (2, chain),
    "spring": (2, spring),
    "hh": (2, henon_heiles),
    "kepler": (2, kepler),
    "pleiades": (14, pleiades),
    "top": (3, top),
    "sph": (2, spherical),
    "cart": (2, cart),
    "nlink3": (3, chain),
    "nlink5": (5, chain),
    "nlink10": (10, chain),
    "nlink20": (20, chain),
}


def derive(name: str) -> list[tuple[Expression, Expression]]:
    """Heyoka's own first-order system."""
    count, lagrangian = SYSTEMS[name]
    q = [hy.make_vars(f"q{i}") for i in range(count)]
    v = [hy.make_vars(f"v{i}") for i in range(count)]
    arguments = [lagrangian(q, v), q, v]
    if name == "cart":
        arguments.append(cart_dissipation(v))
    return hy.lagrangian(*arguments)
