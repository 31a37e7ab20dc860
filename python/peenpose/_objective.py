"""J for optimisers of others."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._problem import PathLike, Problem, problem_of


class Objective:
    """J of many settings at once, on the same shots for all of them, on all cores, with the interpreter free.

    `x` has a row for each setting and the columns `names`, in deg, m and m/s, within `bounds`; a single row will
    do. Where the nozzle does not fit J is `penalty` and more. Verdicts do not count: `evaluate` gives them.
    """

    def __init__(
        self,
        problem: Problem | PathLike,
        contact: str | None = None,
        *,
        shots: int = 1024,
        penalty: float = 1e6,
    ) -> None:
        self._problem = problem_of(problem)
        study = self._problem.study
        self._contact = study.contacts[0] if contact is None else contact
        self._shots = shots
        self._penalty = penalty
        self._core = _core.Objective(study, self._contact, shots=shots, penalty=penalty)

    @property
    def names(self) -> list[str]:
        """Names of the columns: the settings that the file leaves open."""
        return self._core.names

    @property
    def bounds(self) -> list[tuple[float, float]]:
        """Lower and upper ends of the columns."""
        return self._core.bounds

    @property
    def contact(self) -> str:
        """The contact, which is held."""
        return self._contact

    def settings(self, row: ArrayLike) -> dict[str, float | str]:
        """A row as `evaluate` takes it."""
        values = np.asarray(row, dtype=float).tolist()
        return {**dict(zip(self.names, values, strict=True)), "contact": self._contact}

    def __call__(self, x: ArrayLike) -> NDArray[np.float64]:
        rows = np.atleast_2d(np.asarray(x, dtype=np.float64))
        return self._core(rows)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return (_again, (self._problem, self._contact, self._shots, self._penalty))


def _again(problem: Problem, contact: str, shots: int, penalty: float) -> Objective:
    return Objective(problem, contact, shots=shots, penalty=penalty)
