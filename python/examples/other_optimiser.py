"""Scipy's differential evolution on our objective: `python other_optimiser.py keyway.yaml`."""

from __future__ import annotations

import sys

import numpy as np
import peenpose as p
from numpy.typing import NDArray
from scipy.optimize import differential_evolution


def main(file: str, contact: str = "oiled") -> tuple[p.Answer, int]:
    objective = p.Objective(file, contact, shots=1024)

    def of_columns(x: NDArray[np.float64]) -> NDArray[np.float64]:
        return objective(x.T)

    found = differential_evolution(
        of_columns, objective.bounds, vectorized=True, updating="deferred", rng=1, maxiter=40, tol=1e-3, polish=False
    )
    # What the settings are worth on shots that nobody has optimised on, with verdicts.
    best = p.evaluate(file, objective.settings(found.x), shots=65_536).best
    assert best.objective is not None
    print(f"{found.nfev} generations, J {best.objective.total:.5f}, passes: {best.passes}")
    return best, int(found.nfev)


if __name__ == "__main__":
    main(*sys.argv[1:])
