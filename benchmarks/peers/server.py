"""Runs the peers: everything at once, or one request at a time.

After `serve` the first line of standard output is `{"versions": {…}, "subjects": […]}`. Then every line of standard
input is a request `{"system": …, "subject": …, "tolerance": …, "seconds": …}` and is answered by one line: a record as
the benchmarks write it, or `{"failure": …}`. A request repeats the integration for `seconds` (optional), at least
once; `us` is the fastest of those runs. Building the integrator is not part of it: integrators stay
until the system or the tolerance changes.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import compiled
import implicit
import taylor
from problem import Failure, Integrator, Problem, Subject, problems

TOLERANCES = [float(f"1e-{digits}") for digits in range(4, 16)]
# Without a time in the request.
SECONDS = 0.05
# A longer run ends the series of tolerances of a subject in `run`.
SLOW = 0.3e6


class Server:
    """The subjects, and the integrators of the present system and tolerance."""

    def __init__(self) -> None:
        self.problems: dict[str, Problem] = problems()
        self.subjects: dict[str, Subject] = {}
        self.versions = {"Python": platform.python_version()}
        for peers in (taylor, compiled, implicit):
            self.subjects |= {subject.name: subject for subject in peers.subjects()}
            self.versions |= peers.versions()
        self.present: tuple[str, float] | None = None
        self.integrators: dict[str, Integrator] = {}

    def measure(
        self, system: str, subject: str, tolerance: float, seconds: float = SECONDS
    ) -> dict[str, Any]:
        """One record: the time of the fastest run, the error of the last one."""
        if (system, tolerance) != self.present:
            self.present = (system, tolerance)
            self.integrators.clear()
        problem = self.problems[system]
        integrator = self.integrators.get(subject)
        if integrator is None:
            integrator = self.subjects[subject].build(problem, tolerance)
            # Not timed: numba compiles its wrappers in the first call, and caches fill.
            integrator.reset()
            integrator.run()
            self.integrators[subject] = integrator
        times: list[float] = []
        begin = time.perf_counter()
        while not times or time.perf_counter() - begin < seconds:
            integrator.reset()
            start = time.perf_counter()
            integrator.run()
            times.append(time.perf_counter() - start)
        return {
            "benchmark": "precision",
            "system": system,
            "subject": subject,
            "tolerance": tolerance,
            "error": max(problem.error(end) for end in integrator.ends()),
            "us": (min(times) - integrator.overhead) * 1e6 / integrator.trajectories,
            "steps": integrator.steps(),
        }

    def answer(self, line: str) -> dict[str, Any]:
        """Answers one request; what a peer cannot do is an answer as well."""
        try:
            return self.measure(**json.loads(line))
        except Failure as failure:
            return {"failure": str(failure)}

    def serve(self) -> None:
        """Answers until standard input ends."""
        # Compiled peers print what they please; that must not come between the answers.
        answers = os.fdopen(os.dup(sys.stdout.fileno()), "w")
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
        subjects = [{"name": s.name, "systems": s.systems(self.problems)} for s in self.subjects.values()]
        print(json.dumps({"versions": self.versions, "subjects": subjects}), file=answers, flush=True)
        for line in sys.stdin:
            print(json.dumps(self.answer(line)), file=answers, flush=True)

    def everything(self, system: str | None, subject: str | None) -> Iterator[dict[str, Any]]:
        """All records, or those of one system or one subject."""
        for name in self.problems if system is None else [system]:
            slow: set[str] = set()
            for tolerance in TOLERANCES:
                for peer in self.subjects.values():
                    wanted = subject is None or subject == peer.name
                    if not wanted or peer.name in slow or name not in peer.systems(self.problems):
                        continue
                    try:
                        record = self.measure(name, peer.name, tolerance)
                    except Failure as failure:
                        print(f"{name} {peer.name} {tolerance:g}: {failure}", file=sys.stderr)
                        continue
                    if record["us"] > SLOW:
                        slow.add(peer.name)
                    yield record


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description="Integrators from PyPI on the systems of the benchmarks")
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("serve", help="answer requests on standard input")
    run = commands.add_parser("run", help="measure everything")
    run.add_argument("--system", help="one system only")
    run.add_argument("--subject", help="one subject only")
    run.add_argument("--json", type=Path, help="write the records as JSON")
    arguments = parser.parse_args()
    server = Server()
    if arguments.command == "serve":
        server.serve()
        return
    records = []
    for record in server.everything(arguments.system, arguments.subject):
        records.append(record)
        print(
            "{system:10} {subject:28} {tolerance:7.0e} {error:10.1e} {us:12.1f} µs".format(**record),
            flush=True,
        )
    if arguments.json:
        arguments.json.write_text(json.dumps(records, indent=2))


if __name__ == "__main__":
    main()
