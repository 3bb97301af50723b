"""Runs the peers of `many`: the same study by heyoka, one request a line.

A study is the ends of many motions from given starts. heyoka's integrators run one after the other, or in batches of
4 and 8 lanes, whose lanes wait for the last one of them. What is counted is processor time of one thread, without
what calls from Python cost: what heyoka's own `ensemble_propagate_until` adds (copies of the integrator, a callback for
each) is not counted, and its threads are taken for free.
"""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path
from typing import Any

import heyoka as hy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import equations  # noqa: E402
import lagrangians  # noqa: E402

SOURCES = {"lagrangian": lagrangians, "expert": equations}
LANES = (1, 4, 8)
# Empty calls that are timed.
CALLS = 301


class Study:
    """An integrator for a system at a tolerance."""

    def __init__(self, system: str, source: str, lanes: int, tolerance: float) -> None:
        derived = SOURCES[source].derive(system)
        self.lanes = lanes
        self.zero: Any = 0.0
        if lanes == 1:
            self.integrator = hy.taylor_adaptive(derived, np.zeros(len(derived)), tol=tolerance)
        else:
            self.zero = np.zeros(lanes)
            self.integrator = hy.taylor_adaptive_batch(derived, np.zeros((len(derived), lanes)), tol=tolerance)

    def set(self, starts: Any) -> None:
        """Puts states into the lanes."""
        if self.lanes == 1:
            self.integrator.time = 0.0
        else:
            self.integrator.set_time(self.zero)
        self.integrator.state[:] = starts

    def run(self, starts: Any, t_end: float) -> tuple[float, Any]:
        """Processor time [s] and ends; the last batch is filled with motions that are not counted."""
        count = starts.shape[1]
        whole = -(-count // self.lanes) * self.lanes
        starts = np.ascontiguousarray(np.take(starts, range(whole), axis=1, mode="wrap"))
        ends = np.empty_like(starts)
        if self.lanes == 1:
            pieces = [k for k in range(whole)]
            target: Any = t_end
        else:
            pieces = [slice(k, k + self.lanes) for k in range(0, whole, self.lanes)]
            target = np.full(self.lanes, t_end)
        begin = time.process_time()
        for piece in pieces:
            self.set(starts[:, piece])
            self.integrator.propagate_until(target)
            ends[:, piece] = self.integrator.state
        taken = time.process_time() - begin
        return taken - len(pieces) * self.empty(starts[:, pieces[0]]), ends[:, :count]

    def empty(self, start: Any) -> float:
        """Processor time of what Python does for a piece that has nowhere to go [s]."""
        least = np.inf
        for _ in range(3):
            begin = time.process_time()
            for _ in range(CALLS):
                self.set(start)
                self.integrator.propagate_until(self.zero)
            least = min(least, (time.process_time() - begin) / CALLS)
        return float(least)


def main() -> None:
    """Answers until standard input ends."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    print(json.dumps({"versions": {"heyoka": hy.__version__}}), file=answers, flush=True)
    built: dict[tuple[str, str, int, float], Study] = {}
    for line in sys.stdin:
        request = json.loads(line)
        key = (request["system"], request["source"], request["lanes"], request["tolerance"])
        # Subjects take turns at one tolerance.
        built = {known: study for known, study in built.items() if known[3] == key[3]}
        if key not in built:
            built[key] = Study(*key)
        seconds, ends = built[key].run(np.array(request["starts"]).T, request["t_end"])
        answer = {"seconds": seconds, "ends": ends.T.tolist()}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()
