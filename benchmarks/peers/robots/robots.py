"""Pinocchio and its robots, from PyPI.

    python3 benchmarks/peers/robots/robots.py FOLDER

Makes a virtual environment in FOLDER, installs `requirements.txt` into it, writes the models of the robots
as `pinocchio.cpp` reads them, compiles that program, and prints what there is as JSON. What is there already
stays.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import re
import subprocess
import sys
import venv
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
SOURCE = HERE / "pinocchio.cpp"
# As Pinocchio's own files for CMake have them, with everything for the present processor. Its templates are
# compiled here too, since those of the library are for any processor.
FLAGS = [
    "-std=c++20",
    "-O3",
    "-march=native",
    "-DNDEBUG",
    "-w",
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
]
# Name, file, and the coordinates of a base that floats.
SYSTEMS = [
    ("ur5", "ur_description/urdf/ur5_robot.urdf", None),
    ("panda", "panda_description/urdf/panda.urdf", None),
    ("a1", "a1_description/urdf/a1.urdf", None),
    ("a1-floating", "a1_description/urdf/a1.urdf", "angles"),
    ("a1-pose", "a1_description/urdf/a1.urdf", "pose"),
    ("g1", "g1_description/urdf/g1_29dof_rev_1_0.urdf", None),
    ("g1-floating", "g1_description/urdf/g1_29dof_rev_1_0.urdf", "angles"),
    ("g1-pose", "g1_description/urdf/g1_29dof_rev_1_0.urdf", "pose"),
    ("talos", "talos_data/robots/talos_reduced.urdf", None),
    ("talos-floating", "talos_data/robots/talos_reduced.urdf", "angles"),
]
# How near a right angle the importer completes it [rad].
RIGHT = 1e-9
BASES = {
    "angles": ["x", "y", "z", "yaw", "pitch", "roll"],
    "pose": [f"base[{i}]" for i in range(6)],
}
KINDS = {
    "JointModelFreeFlyer": "free",
    "JointModelRevoluteUnaligned": "R",
    "JointModelPrismaticUnaligned": "P",
    **{f"JointModel{kind}{axis}": kind + axis for kind in "RP" for axis in "XYZ"},
}


def install(folder: Path) -> Path:
    """The interpreter of a virtual environment with the requirements."""
    python = folder / "bin" / "python"
    # Written last, so that an interrupted installation is begun again.
    complete = folder / "complete"
    wanted = (HERE / "requirements.txt").read_text()
    if not complete.exists() or complete.read_text() != wanted:
        print("robots: installing Pinocchio and its robots", file=sys.stderr)
        venv.create(folder, with_pip=True, clear=True)
        pip = [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        requirements = ["--requirement", str(HERE / "requirements.txt")]
        subprocess.run(pip + requirements, stdout=sys.stderr, check=True)
        complete.write_text(wanted)
    return python


def compiled(folder: Path, prefix: Path) -> Path:
    """The program in C++."""
    text = SOURCE.read_bytes() + " ".join(FLAGS).encode()
    built = folder / f"pinocchio-{hashlib.sha256(text).hexdigest()[:12]}"
    if not built.exists():
        print("robots: compiling Pinocchio", file=sys.stderr)
        include = prefix / "include"
        search = ["-isystem", str(include), "-isystem", str(include / "eigen3")]
        part = built.with_suffix(".part")
        subprocess.run(["g++", *FLAGS, *search, str(SOURCE), "-o", str(part)], stdout=sys.stderr, check=True)
        part.rename(built)
    return built


def numbers(array: Any) -> str:
    """All entries, row by row, to the last digit."""
    return " ".join(repr(float(entry)) for entry in array.flatten())


def completed(text: str) -> str:
    """A file with right angles of eleven decimals to the last digit, as the importer reads it: so both sides
    have the same robot."""

    def angle(number: str) -> str:
        quarters = round(float(number) / (math.pi / 2))
        right = quarters * (math.pi / 2)
        return repr(right) if abs(float(number) - right) < RIGHT else number

    def angles(found: re.Match[str]) -> str:
        return 'rpy="' + " ".join(map(angle, found[1].split())) + '"'

    return re.sub(r'rpy="([^"]*)"', angles, text)


def export(urdf: Path, base: str | None, output: Path) -> list[str]:
    """Writes a model; its coordinates in order."""
    import pinocchio

    root = [pinocchio.JointModelFreeFlyer()] if base else []
    model = pinocchio.buildModelFromXML(completed(urdf.read_text()), *root)
    lines, coordinates = [], []
    for index in range(1, model.njoints):
        joint, place, inertia = model.joints[index], model.jointPlacements[index], model.inertias[index]
        kind = KINDS[joint.shortname()]
        damping = 0.0 if kind == "free" else float(model.damping[joint.idx_v])
        axis = numbers(joint.extract().axis) if kind in ("R", "P") else "0 0 0"
        if kind == "free":
            kind = base
            coordinates += BASES[base]
        else:
            coordinates.append(model.names[index])
        lines.append(
            f"{model.names[index]} {kind} {model.parents[index]} {axis} {numbers(place.rotation)} "
            f"{numbers(place.translation)} {damping!r} {inertia.mass!r} {numbers(inertia.lever)} "
            f"{numbers(inertia.inertia)}"
        )
    output.write_text(f"{len(lines)}\n" + "\n".join(lines) + "\n")
    return coordinates


def offer(folder: Path) -> None:
    """Inside the environment: writes the models, compiles the program, and tells."""
    from importlib import metadata

    import pinocchio

    prefix = Path(pinocchio.__file__).parents[4]
    robots = prefix / "share" / "example-robot-data" / "robots"
    systems = []
    for name, file, base in SYSTEMS:
        model = folder / f"{name}.txt"
        coordinates = export(robots / file, base, model)
        systems.append(
            {
                "name": name,
                "urdf": str(robots / file),
                "base": base,
                "model": str(model),
                "coordinates": coordinates,
            }
        )
    versions = {package: metadata.version(package) for package in ("pin", "example-robot-data")}
    print(json.dumps({"program": str(compiled(folder, prefix)), "versions": versions, "systems": systems}))


def main() -> None:
    """Installs what is missing and goes on inside the environment."""
    folder = Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    python = install(folder / "venv")
    if Path(sys.prefix).resolve() == (folder / "venv").resolve():
        offer(folder)
    else:
        os.execv(python, [str(python), str(Path(__file__).resolve()), str(folder)])


if __name__ == "__main__":
    main()
