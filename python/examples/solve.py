"""Solves a problem file and writes all reports: `python solve.py keyway.yaml result`."""

from __future__ import annotations

import sys

import peenpose as p


def main(file: str, folder: str) -> p.Result:
    result = p.solve(file)
    settings = result.best.settings
    print(f"{settings.incidence:.1f} deg, {settings.speed:.2f} m/s, {settings.contact}: {result.status}")
    result.save(folder)
    return result


if __name__ == "__main__":
    main(*sys.argv[1:3])
