"""Double pendulums on a graphics processor by JAX 0.11 and diffrax 0.7, from equations by hand, in double precision: `gpu.py MOTIONS`.

Starts, steps and times are those of lagrange-gpu/kernels: RK4 in 256 steps of 1/128 s, Dormand and Prince's method of order 8 for 10 s with tolerance
1e-9. Results stay on the processor. Prints the best of three turns after one that compiles.
"""

import sys
import time

import diffrax
import jax
import jax.numpy as jnp
import numpy as np

jax.config.update("jax_enable_x64", True)
G = 9.81


def starts(count):
    """Angles [rad] at rest, as `spread` in lagrange-gpu/kernels/src/lib.rs has them."""
    index = np.arange(1, count + 1, dtype=np.uint64)
    parts = [
        ((index * np.uint64(step)) >> np.uint64(11)).astype(np.float64) / 2.0**52 - 1.0
        for step in (0xC13FA9A902A6328F, 0x91E10DA5C79E7B1D)
    ]
    angles = [jnp.asarray(np.pi * part) for part in parts]
    return (*angles, jnp.zeros(count), jnp.zeros(count))


def slope(_t, y, _args):
    """Masses of 1 kg on rods of 1 m."""
    q1, q2, v1, v2 = y
    s, c = jnp.sin(q1 - q2), jnp.cos(q1 - q2)
    f1 = -s * v2 * v2 - 2 * G * jnp.sin(q1)
    f2 = s * v1 * v1 - G * jnp.sin(q2)
    det = 2 - c * c
    return v1, v2, (f1 - c * f2) / det, (2 * f2 - c * f1) / det


def adaptive(y):
    solution = diffrax.diffeqsolve(
        diffrax.ODETerm(slope),
        diffrax.Dopri8(),
        0.0,
        10.0,
        0.01,
        y,
        stepsize_controller=diffrax.PIDController(rtol=1e-9, atol=1e-9),
        saveat=diffrax.SaveAt(t1=True),
        max_steps=100_000,
        adjoint=diffrax.ForwardMode(),
    )
    return jnp.stack([x[0] for x in solution.ys])


def rk4(y):
    h = 1 / 128

    def go(y, s, h):
        return tuple(a + h * b for a, b in zip(y, s))

    def step(_, y):
        k1 = slope(0, y, None)
        k2 = slope(0, go(y, k1, h / 2), None)
        k3 = slope(0, go(y, k2, h / 2), None)
        k4 = slope(0, go(y, k3, h), None)
        return tuple(a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(y, k1, k2, k3, k4))

    return jnp.stack(jax.lax.fori_loop(0, 256, step, y))


def measure(name, motion, count):
    y = starts(count)
    run = jax.jit(jax.vmap(motion))
    jax.block_until_ready(run(y))
    best = np.inf
    for _ in range(3):
        start = time.perf_counter()
        jax.block_until_ready(run(y))
        best = min(best, time.perf_counter() - start)
    print(f"{name}: {count / best:.3e} motions/s on {jax.devices()[0].device_kind}", flush=True)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1 << 19
    measure("RK4, JAX", rk4, count)
    measure("Dopri8, diffrax", adaptive, count)
