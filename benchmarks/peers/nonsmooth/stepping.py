"""Peers that take a contact as such, by steps of a fixed length: Siconos' Moreau–Jean scheme, MuJoCo.

The tolerance of a request is the length of a step here. Everything is built anew for each run, which is timed: both keep
state that cannot be put back. Siconos computes its steps in C++ and is called from Python once for each.
"""

from __future__ import annotations

import subprocess
import tempfile
from math import cos, sin, tau
from pathlib import Path
from typing import Any

import numpy as np

from cases import FRICTION, G, HALF, MASS, STIFFNESS
from problem import Integrator, Problem, Subject, Vector

# Of Siconos' contact solvers.
EXACT = 1e-14
PLUGIN = Path(__file__).resolve().parent / "relations.c"


class Siconos:
    """Moreau's midpoint rule with impulses; `start` to `end` in steps of `h`."""

    systems = ("ball", "wall", "coulomb", "belt", "block", "hoop", "valley", "slope")

    def __init__(self) -> None:
        import siconos.kernel as sk

        self.sk = sk
        # Relations that are not linear are called from C; they are found by the name of their library.
        folder = tempfile.mkdtemp()
        self.library = f"{folder}/relations"
        subprocess.run(
            ["gcc", "-shared", "-fPIC", "-O2", str(PLUGIN), "-o", f"{self.library}.so", "-lm"], check=True
        )

    def relation(self, name: str) -> Any:
        """One of `relations.c`."""
        return self.sk.LagrangianScleronomousR(f"{self.library}:{name}_h", f"{self.library}:{name}_G")

    def simulate(self, body: Any, contacts: list[Any], h: float, end: float, solver: Any, **how: Any) -> None:
        """All steps."""
        sk = self.sk
        model = sk.NonSmoothDynamicalSystem(0.0, end)
        model.insertDynamicalSystem(body)
        for contact in contacts:
            model.link(contact, body)
        scheme = how.get("scheme") or sk.MoreauJeanOSI(0.5)
        simulation = sk.TimeStepping(model, sk.TimeDiscretisation(0.0, h), scheme, solver)
        if not how.get("relay"):
            options = solver.numericsSolverOptions()
            options.dparam[0], options.iparam[0] = EXACT, 10000
        if how.get("newton"):
            simulation.setNewtonTolerance(1e-12)
            simulation.setNewtonMaxIteration(50)
        each = how.get("each")
        for step in range(round(end / h)):
            if each:
                each((step + 0.5) * h)
            simulation.computeOneStep()
            simulation.nextStep()

    def run(self, problem: Problem, h: float) -> list[float]:
        """The state at the end of a case."""
        return getattr(self, problem.name)(problem, h)

    def contact(self, law: Any, rows: list[list[float]]) -> Any:
        """A linear one."""
        return self.sk.Interaction(law, self.sk.LagrangianLinearTIR(rows))

    def ball(self, problem: Problem, h: float) -> list[float]:
        """Newton's restitution."""
        sk = self.sk
        body = sk.LagrangianLinearTIDS([1.0], [0.0], [[1.0]])
        body.setFExtPtr([-G])
        self.simulate(
            body, [self.contact(sk.NewtonImpactNSL(0.8), [[1.0]])], h, problem.t_end, sk.LCP()
        )
        return [body.q()[0], body.velocity()[0]]

    def wall(self, problem: Problem, h: float) -> list[float]:
        """The pendulum in Cartesian coordinates would need a joint; its force comes from Python instead."""
        sk = self.sk

        class Pendulum(sk.LagrangianDS):
            """θ with inertia l²."""

            def __init__(self) -> None:
                sk.LagrangianDS.__init__(self, [1.3], [0.0], [[0.64]])
                self.setFIntPtr(np.zeros(1))
                self.setJacobianFIntqPtr(np.zeros((1, 1)))
                self.setJacobianFIntqDotPtr(np.zeros((1, 1)))

            def computeFInt(self, _: float, *at: Any) -> None:
                self.fInt()[0] = 0.8 * G * sin((at[0] if len(at) >= 2 else self.q())[0])

            def computeJacobianFIntq(self, *_: Any) -> None:
                pass

            def computeJacobianFIntqDot(self, *_: Any) -> None:
                pass

        body = Pendulum()
        contact = self.contact(sk.NewtonImpactNSL(0.9), [[1.0]])
        self.simulate(body, [contact], h, problem.t_end, sk.LCP(), newton=True)
        return [body.q()[0], body.velocity()[0]]

    def coulomb(self, problem: Problem, h: float) -> list[float]:
        """On a floor that carries the weight."""
        sk = self.sk
        mass, stiffness = np.diag([MASS, MASS]), np.diag([STIFFNESS, 0.0])
        body = sk.LagrangianLinearTIDS([0.7, 0.0], [0.0, 0.0], mass, stiffness, np.zeros((2, 2)))
        body.setFExtPtr([0.0, -MASS * G])
        law = sk.NewtonImpactFrictionNSL(0.0, 0.0, 0.25, 2)
        contact = self.contact(law, [[0.0, 1.0], [1.0, 0.0]])
        self.simulate(body, [contact], h, problem.t_end, sk.FrictionContact(2))
        return [body.q()[0], body.velocity()[0]]

    def belt(self, problem: Problem, h: float) -> list[float]:
        """In the frame of the belt. Its law has one coefficient, which is switched by hand after each step."""
        sk = self.sk
        body = sk.LagrangianLinearTIDS(
            [0.0, 0.0], [0.0, 0.0], np.eye(2), np.diag([9.0, 0.0]), np.zeros((2, 2))
        )
        body.setFExtPtr([0.0, -8.0])
        law = sk.NewtonImpactFrictionNSL(0.0, 0.0, 0.5, 2)
        contact = self.contact(law, [[0.0, 1.0], [1.0, 0.0]])

        def each(middle: float) -> None:
            law.setMu(0.5 if abs(body.velocity()[0]) < 1e-13 else 0.3)
            body.fExt()[0] = -9.0 * 0.2 * middle

        self.simulate(body, [contact], h, problem.t_end, sk.FrictionContact(2), each=each)
        return [body.q()[0] + 0.2 * problem.t_end, body.velocity()[0] + 0.2]

    def block(self, problem: Problem, h: float) -> list[float]:
        """Two corners that neither bounce nor slide."""
        sk = self.sk
        (b, half), angle = HALF, -problem.start[0]
        body = sk.LagrangianLinearTIDS(
            [-(b * cos(angle) + half * sin(angle)), half * cos(angle) - b * sin(angle), angle],
            [0.0] * 3,
            np.diag([1.0, 1.0, (b * b + half * half) / 3.0]),
        )
        body.setFExtPtr([0.0, -G, 0.0])
        law = [sk.NewtonImpactFrictionNSL(0.0, 0.0, 3.0, 2) for _ in range(2)]
        corners = [sk.Interaction(law, self.relation(name)) for law, name in zip(law, ("right", "left"))]
        self.simulate(body, corners, h, problem.t_end, sk.FrictionContact(2), newton=True)
        return [-body.q()[2], -body.velocity()[2]]

    def hoop(self, problem: Problem, h: float) -> list[float]:
        """The bead inside the hoop, which it never leaves here."""
        sk = self.sk
        angle = problem.start[0]
        body = sk.LagrangianLinearTIDS([0.5 * sin(angle), -0.5 * cos(angle)], [0.0, 0.0], np.eye(2))
        body.setFExtPtr([0.0, -G])
        contact = sk.Interaction(sk.NewtonImpactFrictionNSL(0.0, 0.0, 0.2, 2), self.relation("hoop"))
        self.simulate(body, [contact], h, problem.t_end, sk.FrictionContact(2), newton=True)
        (x, y), (u, w) = body.q(), body.velocity()
        return [float(np.arctan2(x, -y)), float((w * x - u * y) / (x * x + y * y))]

    def valley(self, problem: Problem, h: float) -> list[float]:
        """A relay."""
        sk = self.sk
        body = sk.FirstOrderLinearDS([1.0, 0.0], [[0.0, 1.0], [0.0, 0.0]])
        relation = sk.FirstOrderLinearTIR([[1.0, 0.0]], [[0.0], [1.0]])
        contact = sk.Interaction(sk.RelayNSL(1), relation)
        self.simulate(
            body, [contact], h, problem.t_end, sk.Relay(), scheme=sk.EulerMoreauOSI(0.5), relay=True
        )
        return list(body.x())

    def slope(self, problem: Problem, h: float) -> list[float]:
        """Friction in two directions."""
        sk = self.sk
        body = sk.LagrangianLinearTIDS([0.0, 0.0, 0.0], [0.0, 2.0, 0.0], np.eye(3))
        body.setFExtPtr([G * sin(0.3), 0.0, -G * cos(0.3)])
        law = sk.NewtonImpactFrictionNSL(0.0, 0.0, 0.45, 3)
        contact = self.contact(law, [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
        self.simulate(body, [contact], h, problem.t_end, sk.FrictionContact(3))
        return [*body.q()[:2], *body.velocity()[:2]]


class Mujoco:
    """Soft contacts; the settings that came nearest to rigid ones."""

    systems = ("ball", "coulomb", "slope")

    def __init__(self) -> None:
        import mujoco

        self.mujoco = mujoco

    def run(self, problem: Problem, h: float) -> list[float]:
        """The state at the end of a case."""
        head, body, start = getattr(self, problem.name)(h)
        options = f'<option timestep="{h}" {head}/>'
        floor = '<geom type="plane" size="50 50 .1" friction="0 0 0"/>'
        text = f"<mujoco>{options}<worldbody>{floor}{body}</worldbody></mujoco>"
        model = self.mujoco.MjModel.from_xml_string(text)
        data = self.mujoco.MjData(model)
        data.qpos[:], data.qvel[:] = start
        self.mujoco.mj_step(model, data, round(problem.t_end / h))
        dimension = len(problem.start) // 2
        q = [x + (1.0 if problem.name == "ball" else 0.0) for x in data.qpos[:dimension]]
        return [*q, *data.qvel[:dimension]]

    def ball(self, h: float) -> tuple[str, str, Any]:
        """A contact of ten steps, damped for a restitution of 0.8."""
        rate = tau / (20.0 * h)
        spring = f'solref="{-rate * rate:.17g} {-2.0 * 0.0714 * rate:.17g}" solimp="0.9999 0.9999 0.001 0.5 2"'
        ball = f'<geom type="sphere" size=".1" mass="1" priority="1" condim="1" {spring}/>'
        body = f'<body pos="0 0 1.1"><joint type="slide" axis="0 0 1"/>{ball}</body>'
        return f'gravity="0 0 {-G}"', body, ([0.0], [0.0])

    def coulomb(self, h: float) -> tuple[str, str, Any]:
        """Friction as a loss of the joint."""
        joint = f'<joint type="slide" axis="1 0 0" stiffness="{STIFFNESS}" frictionloss="{FRICTION}"/>'
        body = f'<body pos="0 0 1">{joint}<geom type="sphere" size=".1" mass="{MASS}"/></body>'
        return 'gravity="0 0 0"', body, ([0.7], [0.0])

    def slope(self, h: float) -> tuple[str, str, Any]:
        """A cone without slip, as the manual recommends against creep."""
        head = f'gravity="{G * sin(0.3):.17g} 0 {-G * cos(0.3):.17g}" cone="elliptic" noslip_iterations="10"'
        joints = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1"))
        ball = '<geom type="sphere" size=".1" mass="1" friction=".45 .005 .0001"/>'
        return head, f'<body pos="0 0 .1">{joints}{ball}</body>', ([0.0] * 3, [0.0, 2.0, 0.0])


class Stepped(Integrator):
    """A run of one of them."""

    def __init__(self, peer: Any, problem: Problem, h: float) -> None:
        self.peer, self.problem, self.h = peer, problem, h
        self.end: list[float] = []

    def reset(self) -> None:
        self.end = []

    def run(self) -> None:
        self.end = self.peer.run(self.problem, self.h)

    def ends(self) -> list[Vector]:
        return [np.array(self.end)]

    def steps(self) -> int:
        return round(self.problem.t_end / self.h)


class Stepping(Subject):
    """One of them."""

    def __init__(self, name: str, peer: Any) -> None:
        self.name, self.peer = name, peer

    def systems(self, names: dict[str, Problem]) -> list[str]:
        return [name for name in names if name in self.peer.systems]

    def build(self, problem: Problem, tolerance: float) -> Integrator:
        return Stepped(self.peer, problem, tolerance)


def offers() -> tuple[list[Subject], dict[str, str]]:
    """What is installed, and its versions."""
    subjects: list[Subject] = []
    versions: dict[str, str] = {}
    try:
        siconos = Siconos()
        subjects.append(Stepping("siconos", siconos))
        versions["Siconos"] = getattr(siconos.sk, "__version__", "of the distribution")
    except ImportError:
        pass
    try:
        mujoco = Mujoco()
        subjects.append(Stepping("mujoco", mujoco))
        versions["MuJoCo"] = mujoco.mujoco.__version__
    except ImportError:
        pass
    return subjects, versions
