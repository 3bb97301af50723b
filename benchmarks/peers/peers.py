"""The integrators from PyPI on the systems of the benchmarks.

    python3 benchmarks/peers/peers.py run [--system S] [--subject NAME] [--json FILE]
    python3 benchmarks/peers/peers.py serve
    python3 benchmarks/peers/peers.py nonsmooth
    python3 benchmarks/peers/peers.py many

The first call makes a virtual environment beside this file and installs `requirements.txt` into it. `run`
prints and writes one record for each system, subject and tolerance. `serve` answers requests line by line,
see `server.py`; the command `report` uses it to measure these subjects and ours in turn. `nonsmooth` does so for systems
with contacts, see `nonsmooth/serve.py`, `many` for studies of many motions by heyoka, see `many/serve.py`.
"""

from __future__ import annotations

import os
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ENVIRONMENT = HERE / ".venv"
PYTHON = ENVIRONMENT / "bin" / "python"
# Written last, so that an interrupted installation is begun again.
COMPLETE = ENVIRONMENT / "complete"


def install() -> None:
    """Makes the virtual environment unless it is there for the same requirements."""
    wanted = (HERE / "requirements.txt").read_text()
    if COMPLETE.exists() and COMPLETE.read_text() == wanted:
        return
    print("peers: making a virtual environment and installing the peers", file=sys.stderr)
    venv.create(ENVIRONMENT, with_pip=True, clear=True)
    for line in wanted.splitlines():
        if line and not line.startswith("#"):
            pip = [str(PYTHON), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", line]
            # Standard output belongs to the records.
            if subprocess.run(pip, stdout=sys.stderr).returncode != 0:
                print(f"peers: {line} could not be installed; its subjects are left out", file=sys.stderr)
    COMPLETE.write_text(wanted)


def main() -> None:
    """Installs what is missing and hands over to the server inside the environment."""
    install()
    others = [name for name in ("nonsmooth", "many") if sys.argv[1:] == [name]]
    script = HERE / (f"{others[0]}/serve.py" if others else "server.py")
    os.execv(PYTHON, [str(PYTHON), str(script), *sys.argv[1:]])


if __name__ == "__main__":
    main()
