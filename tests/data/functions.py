"""Values of elementary functions with 45 digits, for the double-double scalar.

    pip install mpmath==1.3.0; python tests/data/functions.py > tests/data/functions.txt

A line is a function, its arguments as two doubles each (their sum is the argument, exactly), and the value. The seed is fixed, so
the same lines come out again.
"""

import random

from mpmath import mp, mpf

mp.prec = 2500
random.seed(19710401)


def pair(x):
    high = float(x)
    return high, float(x - mpf(high))


def exact(p):
    return mpf(p[0]) + mpf(p[1])


def line(name, function, *arguments):
    arguments = [pair(mpf(a)) for a in arguments]
    value = function(*map(exact, arguments))
    parts = " ".join(repr(part) for p in arguments for part in p)
    print(name, parts, mp.nstr(value, 45, strip_zeros=False, min_fixed=0, max_fixed=0))


def between(low, high):
    """A random number with 107 bits."""
    return mpf(low) + (mpf(high) - mpf(low)) * mpf(random.getrandbits(200)) / 2**200


def sizes(low, high, count):
    """Random numbers between powers of ten."""
    return [mpf(10) ** between(low, high) for _ in range(count)]


def both(values):
    return [s * x for x in values for s in (1, -1)]


near_zero = sizes(-300, -1, 8)
angles = both(sizes(-300, 0, 5)) + both([between(0, 7) for _ in range(6)]) + both(sizes(1, 22, 6)) + sizes(22, 307, 6)
# Beside multiples of π/2, where next to nothing is left of the argument; the first is the worst double.
beside = [mpf(6381956970095103) * mpf(2) ** 797] + [k * mp.pi / 2 for k in (1, 2, 3, 7, 10**6 + 1, 10**15 + 3, 10**100)]
for name, function in [("sin", mp.sin), ("cos", mp.cos), ("tan", mp.tan)]:
    for x in angles + beside:
        line(name, function, x)
within = both(near_zero[:4]) + both([between(0, 1) for _ in range(6)]) + both([1 - x for x in sizes(-30, -2, 4)])
for name, function in [("asin", mp.asin), ("acos", mp.acos), ("atanh", mp.atanh)]:
    for x in within:
        line(name, function, x)
for x in both(near_zero + [between(0, 3) for _ in range(4)] + sizes(1, 300, 6)):
    line("atan", mp.atan, x)
    line("asinh", mp.asinh, x)
for _ in range(40):
    y, x = (random.choice((1, -1)) * mpf(10) ** between(-6, 6) for _ in range(2))
    line("atan2", mp.atan2, y, x)
for y, x in [(1e-290, 1e5), (1e-200, -1e5), (1e300, 1e-5), (-1e300, -1e299), (1e-300, 3e-300), (-1e-17, 1), (1e-17, -1), (1, 1e-17)]:
    line("atan2", mp.atan2, y, x)
for x in [1 + x for x in sizes(-30, 0, 8)] + sizes(0.1, 300, 8):
    line("acosh", mp.acosh, x)
for x in both(near_zero + sizes(-3, 2.8, 16)):
    line("exp", mp.exp, x)
    line("exp_m1", mp.expm1, x)
    line("sinh", mp.sinh, x)
    line("cosh", mp.cosh, x)
    line("tanh", mp.tanh, x)
line("sinh", mp.sinh, 710.3)
line("cosh", mp.cosh, -710.3)
for x in sizes(-307, 307, 16) + [between(0.4, 2.5) for _ in range(8)] + [1 + x for x in both(sizes(-33, -1, 8))]:
    line("ln", mp.log, x)
for x in both(near_zero + sizes(-40, -0.35, 8)) + sizes(0, 300, 8) + [x - 1 for x in sizes(-30, -1, 6)]:
    line("ln_1p", mp.log1p, x)
for x in sizes(-290, 300, 20):
    line("sqrt", mp.sqrt, x)
    line("cbrt", mp.cbrt, x)
    line("cbrt", lambda x: -mp.cbrt(-x), -x)
for _ in range(30):
    line("powf", mp.power, mpf(10) ** between(-2, 2), between(-20, 20))
    line("hypot", mp.hypot, mpf(10) ** between(-3, 3), mpf(10) ** between(-3, 3))
for y in (2, 3, -5, 101, -102):
    line("powf", mp.power, -between(0.1, 2), y)
for a, b in [(1e300, 3e300), (3e-300, 2e-300), (5e200, 7e-200)]:
    line("hypot", mp.hypot, a, b)
