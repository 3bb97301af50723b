"""Writes `../../nonsmooth.json`: where each case starts, when it stops and where it is then, to thirty digits.

The cases with modes have other starts beside the first one: the error of a single motion to the last digits is chance.
Between events the motions are elementary where they can be, else Taylor series; events are roots of these. Constants of
the modes of `block` are doubles, as in programs: all share their rounding errors, which are larger than those of a run.

    python3 benchmarks/peers/nonsmooth/references.py
"""

from __future__ import annotations

import json
import random
from pathlib import Path

import mpmath as mp

import cases

mp.mp.dps = 40


def d(number):
    """A parameter as programs have it: the nearest double of a decimal."""
    return mp.mpf(float(number))


G = d("9.81")
# Those of the modes, as doubles.
SQUARE, ALPHA, LEFT = d(cases.SQUARE), d(cases.ALPHA), d(cases.LEFT)
# How many other starts a case has.
OTHERS = 60
# Steps [s] and orders of Taylor series: 0.05 is a sixtieth of the radius of convergence or less.
STEP, ORDERS = mp.mpf("0.05"), 32
# (start, time to stop); of `slope` the state is (downhill, across) and its rates.
RUNS = {
    "ball": (["1", "0"], "3"),
    "wall": (["1.3", "0"], "4.5"),
    "coulomb": (["0.7", "0"], "3"),
    "belt": (["0", "0.2"], "300"),
    "block": ([mp.mpf("0.6") * mp.atan(d("0.2") / d("0.5")), "0"], "1.5"),
    "hoop": (["1.2", "0"], "1"),
    "bilinear": (["1", "0"], "1000"),
    "valley": (["1", "0"], "1000"),
}
# The interval of the other starts, all with the velocity of the first one. A ball from less than 0.7 m comes to rest
# before the end, after infinitely many impacts. All motions on a belt approach one cycle and have its rounding errors, so
# each start has a belt of its own.
SPEEDS = (0.1, 0.4)
STARTS = {
    "ball": (0.8, 1.6),
    "wall": (0.8, 1.6),
    "coulomb": (0.3, 1.0),
    "belt": (-0.4, 0.4),
    "block": (0.1, 0.3),
    "hoop": (0.8, 1.5),
    "bilinear": (0.5, 2.0),
    "valley": (0.5, 2.0),
}
# The steps [s] in which a guard is looked at, a tenth of the shortest piece or less.
SCANS = {"belt": "0.05", "bilinear": "0.1", "valley": "0.1"}


def pendulum(k, phase, state, drag=0):
    """The motion of x'' = −k sin(x − phase) − drag (x'² + k cos x), as a function of time."""
    pieces = []

    def series(x, v):
        xs, sin, cos = [x, v], [mp.sin(x - phase)], [mp.cos(x - phase)]
        for n in range(ORDERS):
            square = mp.fsum((i + 1) * xs[i + 1] * (n - i + 1) * xs[n - i + 1] for i in range(n + 1)) if drag else 0
            xs.append(-(k * sin[n] + drag * (square + k * cos[n])) / ((n + 1) * (n + 2)))
            turned = lambda of: mp.fsum(i * xs[i] * of[n + 1 - i] for i in range(1, n + 2)) / (n + 1)
            grown = turned(cos), -turned(sin)
            sin.append(grown[0])
            cos.append(grown[1])
        return xs[::-1], [i * x for i, x in enumerate(xs)][:0:-1]

    def flow(t):
        place = int(t / STEP)
        while len(pieces) <= place:
            pieces.append(series(*(state if not pieces else (mp.polyval(c, STEP) for c in pieces[-1]))))
        return [mp.polyval(c, t - place * STEP) for c in pieces[place]]

    return flow


def oscillator(square, centre, state):
    """The motion of x'' = −square (x − centre)."""
    w, x, v = mp.sqrt(square), state[0] - centre, state[1]
    return lambda t: [
        centre + x * mp.cos(w * t) + v / w * mp.sin(w * t),
        v * mp.cos(w * t) - x * w * mp.sin(w * t),
    ]


def parabola(a, state):
    """The motion of x'' = a."""
    return lambda t: [state[0] + state[1] * t + a * t * t / 2, state[1] + a * t]


def motion(name, state, p):
    """The motion of a case in a mode."""
    if name == "ball":
        return parabola(-G, state)
    if name == "valley":
        return parabola(-d(p), state)
    if name == "bilinear":
        return oscillator(d("6.5") - d("2.5") * d(p), 0, state)
    if name == "coulomb":
        return oscillator(d(25), -d(p) * G / 100, state) if p else lambda t: state
    if name == "belt":
        return oscillator(d(9), d("2.4") / 9, state) if p else parabola(0, state)
    if name == "wall":
        return pendulum(G / d("0.8"), 0, state)
    if name == "block":
        return pendulum(-SQUARE, d(p) * ALPHA, state)
    if name == "hoop":
        return pendulum(G / d("0.5"), 0, state, d(p) * d("0.2")) if p else lambda t: state
    raise KeyError(name)


def after(name, s, p, speed):
    """What follows an event. `speed` is that of the belt."""
    if name in ("ball", "wall"):
        return [d(0), -d("0.8" if name == "ball" else "0.9") * s[1]], p
    if name == "block":
        return [d(0), LEFT * s[1]], -p
    if name == "belt":
        return ([d(4) / 9, s[1]], 1.0) if p == 0 else ([s[0], speed], 0.0)
    if name in ("bilinear", "valley"):
        return [d(0), s[1]], -p
    return cases.CASES[name].after(s, p)


def run(name, state, end):
    """The state at the end, event by event."""
    case, t, speed = cases.case(name, state), mp.mpf(0), state[1]
    p = case.mode
    while t < end:
        path = motion(name, state, p)
        guard = lambda s: case.guard(*path(s), p)
        # From beside the start, where the guard is zero.
        step = mp.mpf(SCANS.get(name, "0.01"))
        low = step
        while t + low < end and guard(low + step) > 0:
            low += step
        if t + low + step >= end and (t + low >= end or guard(end - t) > 0):
            return path(end - t)
        at = mp.findroot(guard, (low, low + step), solver="anderson", tol=mp.mpf(10) ** -70)
        state, p = after(name, [+x for x in path(at)], p, speed)
        t += at
    return state


def slope():
    """Slides across a slope of 0.3 rad with 0.45 until it rests: from v' = g sin a cos b − m, v b' = −g sin a sin b."""
    down, drag = G * mp.sin(d("0.3")), d("0.45") * G * mp.cos(d("0.3"))
    # b: from downhill to the velocity, v sin b times a power of tan(b / 2) stays.
    k = drag / down
    speed = lambda b: 2 / mp.sin(b) * mp.tan(b / 2) ** k
    time = lambda b: speed(b) / (down * mp.sin(b))
    x = mp.quad(lambda b: speed(b) * mp.cos(b) * time(b), [0, mp.pi / 4, mp.pi / 2])
    y = mp.quad(lambda b: speed(b) * mp.sin(b) * time(b), [0, mp.pi / 4, mp.pi / 2])
    return [x, y, 0, 0]


def main():
    """All cases."""
    text = lambda x: float(mp.nstr(x, 25))
    out = {}
    for name, (start, end) in RUNS.items():
        draws = random.Random(name)
        speed = lambda: draws.uniform(*SPEEDS) if name == "belt" else start[1]
        starts = [start] + [[draws.uniform(*STARTS[name]), speed()] for _ in range(OTHERS)]
        motions = []
        for start in ([d(x) for x in start] for start in starts):
            found = run(name, start, mp.mpf(end))
            motions.append({"start": [text(x) for x in start], "end": [text(x) for x in found]})
            print(name, motions[-1], flush=True)
        out[name] = {"t_end": float(end), **motions[0], "others": motions[1:]}
    out["slope"] = {"t_end": 2.0, "start": [0.0, 0.0, 0.0, 2.0], "end": [text(x) for x in slope()]}
    print(out["slope"])
    path = Path(__file__).resolve().parents[2] / "nonsmooth.json"
    path.write_text(json.dumps(out, indent=1) + "\n")


if __name__ == "__main__":
    main()
