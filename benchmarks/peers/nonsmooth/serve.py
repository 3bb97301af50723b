"""Runs the peers of `nonsmooth`: one request a line, as `../server.py` does for the other benchmarks.

Whatever this Python can import is offered: heyoka, SciPy and MuJoCo come from PyPI, Siconos from the packages of a
distribution (`apt-get install python3-siconos`) and so for the Python of that.
"""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import modes  # noqa: E402
import stepping  # noqa: E402
from problem import Failure, Integrator, problems  # noqa: E402


def main() -> None:
    """Answers until standard input ends."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    known = problems(HERE.parents[1] / "nonsmooth.json")
    subjects: dict[str, Any] = {}
    versions: dict[str, str] = {}
    for source in (modes, stepping):
        offered, of_these = source.offers()
        subjects |= {subject.name: subject for subject in offered}
        versions |= of_these
    offers = [{"name": s.name, "systems": s.systems(known)} for s in subjects.values()]
    print(json.dumps({"versions": versions, "subjects": offers}), file=answers, flush=True)
    built: dict[tuple[str, str, float], Integrator] = {}
    for line in sys.stdin:
        request = json.loads(line)
        system, subject, tolerance = request["system"], request["subject"], request["tolerance"]
        try:
            problem = known[system]
            # One integrator for all starts of a system.
            key = (problem.name, subject, tolerance)
            if key not in built:
                built[key] = subjects[subject].build(problem, tolerance)
            run = built[key]
            run.problem = problem
            times: list[float] = []
            begin = time.perf_counter()
            while not times or time.perf_counter() - begin < request["seconds"]:
                run.reset()
                start = time.perf_counter()
                run.run()
                times.append(time.perf_counter() - start)
            error = max(problem.error(end) for end in run.ends())
            answer = {"us": min(times) * 1e6, "error": error, "steps": run.steps()}
        # Peers raise whatever they please.
        except (Failure, Exception) as cause:
            answer = {"failure": f"{type(cause).__name__}: {cause}"}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()
