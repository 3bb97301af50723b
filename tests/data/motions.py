"""Reference motions with 40 digits.

    pip install mpmath==1.3.0 gmpy2; python tests/data/motions.py

Closed forms, but for the double pendulum: there the extrapolated midpoint rule of Gragg, Bulirsch and Stoer with 22 columns, with two
lengths of the step that have to agree.
"""

from mpmath import cos, ellipfun, findroot, mp, mpf, nstr, sin, sqrt, asin

mp.dps = 50


def show(name, values):
    print(name, "[" + ", ".join(f'"{nstr(x, 40)}"' for x in values) + "]", flush=True)


def kepler(e, t):
    """GM = 1, a = 1, from the pericentre on the x axis: x, y and their rates."""
    anomaly = findroot(lambda E: E - e * sin(E) - t, t)
    r = 1 - e * cos(anomaly)
    b = sqrt(1 - e * e)
    return [cos(anomaly) - e, b * sin(anomaly), -sin(anomaly) / r, b * cos(anomaly) / r]


def pendulum(g, start, t):
    """Length 1, from rest at an angle: x, y and their rates. sin(θ/2) = k cd(ωt | k²) with k = sin(θ₀/2)."""
    k, omega = sin(start / 2), sqrt(g)
    m = k * k
    cd, sd, nd = (ellipfun(kind, omega * t, m=m) for kind in ("cd", "sd", "nd"))
    theta = 2 * asin(k * cd)
    rate = -2 * k * omega * (1 - m) * sd * nd / cos(theta / 2)
    return [sin(theta), -cos(theta), rate * cos(theta), rate * sin(theta)]


def double_pendulum(y):
    """Masses and lengths 1, g = 9.81: the slope of both angles and rates."""
    a, b, va, vb = y
    g, s, c = mpf(981) / 100, sin(a - b), cos(a - b)
    first, second = -s * vb * vb - 2 * g * sin(a), s * va * va - g * sin(b)
    return [va, vb, (first - c * second) / (2 - c * c), (2 * second - c * first) / (2 - c * c)]


def extrapolated(f, y, t, steps, columns=22):
    h = mpf(t) / steps
    for _ in range(steps):
        slope = f(y)
        table = []
        for j in range(1, columns + 1):
            n = 2 * j
            d = h / n
            last, now = y, [a + d * b for a, b in zip(y, slope)]
            for _ in range(n - 1):
                last, now = now, [a + 2 * d * b for a, b in zip(last, f(now))]
            row = [[(a + b + d * c) / 2 for a, b, c in zip(last, now, f(now))]]
            for k, before in enumerate(table, 1):
                ratio = (mpf(n) / (n - 2 * k)) ** 2
                row.append([a + (a - b) / (ratio - 1) for a, b in zip(row[-1], before)])
            table = row
        y = table[-1]
    return y


show("oscillator, ω² = 0.1 / 0.3, t = 7", [cos(7 / sqrt(mpf(3))), -sin(7 / sqrt(mpf(3))) / sqrt(mpf(3))])
show("kepler, e = 0.6, t = 20", kepler(mpf(6) / 10, 20))
show("pendulum, g = 9.81, from 1.5 rad, t = 10", pendulum(mpf(981) / 100, mpf(3) / 2, 10))
for t, steps in [(10, 560), (10, 700)]:
    show(f"double pendulum, from 2 rad both, t = {t}, {steps} steps", extrapolated(double_pendulum, [mpf(2), mpf(2), mpf(0), mpf(0)], t, steps))
