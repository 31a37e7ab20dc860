"""`python -m peenpose`: the program of this package."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path


def _program() -> Path | None:
    schemes = [sysconfig.get_default_scheme(), sysconfig.get_preferred_scheme("user")]
    name = "peenpose.exe" if sys.platform == "win32" else "peenpose"
    paths = (Path(sysconfig.get_path("scripts", scheme)) / name for scheme in schemes)
    return next((path for path in paths if path.is_file()), None)


def main() -> int:
    """Runs the program with the arguments of this process, in its place where the system can."""
    program = _program()
    if program is None:
        print(
            "peenpose: this package was built without the program: take a wheel that python/build.sh makes,"
            " or `cargo install peenpose`",
            file=sys.stderr,
        )
        return 2
    if os.name == "posix":
        # In place of this process, so that signals reach it: Ctrl-C ends it with the best answer so far.
        os.execv(program, [str(program), *sys.argv[1:]])
    return subprocess.run([program, *sys.argv[1:]]).returncode


if __name__ == "__main__":
    sys.exit(main())
