"""The problems to solve, and what a peer has to provide."""

from __future__ import annotations

import json
from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
REFERENCES = Path(__file__).resolve().parent.parent / "references.json"


class Failure(Exception):
    """What a peer could not do."""


@dataclass(frozen=True)
class Problem:
    """A system, its start and its state at the end, (q, v), good to the last digit."""

    name: str
    t_end: float
    start: Vector
    end: Vector

    def error(self, found: Vector) -> float:
        """Largest deviation of a coordinate or velocity, relative where it is above one."""
        return float(np.max(np.abs(found - self.end) / np.maximum(1.0, np.abs(self.end))))


def problems(path: Path = REFERENCES) -> dict[str, Problem]:
    """The problems that Rust and Python share; those from other starts have their place behind a slash."""
    found = {}
    for name, entry in json.loads(path.read_text()).items():
        for place, motion in enumerate([entry, *entry.get("others", [])]):
            key = f"{name}/{place}" if place else name
            found[key] = Problem(name, entry["t_end"], np.array(motion["start"]), np.array(motion["end"]))
    return found


class Integrator(ABC):
    """A peer, built for one problem and one tolerance."""

    # How many motions one run integrates.
    trajectories = 1
    # Time of a run that does nothing, if it can be told [s]; not the peer's fault, and subtracted.
    overhead = 0.0

    @abstractmethod
    def reset(self) -> None:
        """Goes back to the start. Not timed."""

    @abstractmethod
    def run(self) -> None:
        """Integrates to the end. Timed."""

    @abstractmethod
    def ends(self) -> list[Vector]:
        """The states that the last run reached."""

    @abstractmethod
    def steps(self) -> int:
        """Steps of the last run; zero if the peer does not tell."""


class Subject(ABC):
    """A way to integrate that appears under its own name."""

    name: str

    def systems(self, names: dict[str, Problem]) -> list[str]:
        """The systems that it can do."""
        return list(names)

    @abstractmethod
    def build(self, problem: Problem, tolerance: float) -> Integrator:
        """Prepares one integration; compiles whatever has to be compiled."""
