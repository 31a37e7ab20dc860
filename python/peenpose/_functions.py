"""What there is to ask."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from decimal import Decimal
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core, campaigns
from ._map import Map
from ._problem import PathLike, Problem, problem_of
from ._result import Result, Settings
from ._table import Table

Progress = Callable[[str, int, float | None], object]
"""Is called with `("search", poses, least J so far)` or with a step, its number and how many there are."""


def _percent(accuracy: float | str | None) -> str | None:
    # The shortest decimal, so that 0.07 is 7 % and not the nearest number to it.
    return accuracy if accuracy is None or isinstance(accuracy, str) else f"{Decimal(repr(accuracy)) * 100} %"


def _settings(settings: Settings | Mapping[str, float | str]) -> tuple[dict[str, float | str], bool]:
    # Those of an answer keep their friction only where the problem leaves it open.
    if isinstance(settings, Settings):
        return settings.to_dict(), True
    return dict(settings), False


def solve(
    problem: Problem | PathLike,
    *,
    accuracy: float | str | None = None,
    seed: int | None = None,
    threads: int | None = None,
    pareto: bool = False,
    evidence: bool = True,
    progress: Progress | None = None,
) -> Result:
    """The best settings, with proof.

    `accuracy` is relative to J (0.01 or "1 %"); file and seed decide the answer to the last bit, whatever `threads`.
    Ctrl-C gives the best so far, with the status `interrupted`. `evidence` is what pictures and `hits` are made from.

    Raises ProblemError where the problem has faults.
    """
    record = problem_of(problem).study.solve(
        accuracy=_percent(accuracy),
        seed=seed,
        threads=threads,
        pareto=pareto,
        evidence=evidence,
        progress=progress,
    )
    return Result(record)


def evaluate(
    problem: Problem | PathLike,
    settings: Settings | Mapping[str, float | str],
    *,
    shots: int = 16_384,
    seed: int | None = None,
    threads: int | None = None,
    evidence: bool = True,
) -> Result:
    """What given settings do. Numbers are in deg, m and m/s; texts have a unit (`{"speed": "9.4 m/s"}`)."""
    given, answered = _settings(settings)
    record = problem_of(problem).study.evaluate(
        given, answered=answered, shots=shots, seed=seed, threads=threads, evidence=evidence
    )
    return Result(record)


def map(
    problem: Problem | PathLike,
    x: str,
    y: str,
    term: str = "total",
    *,
    settings: Settings | Mapping[str, float | str],
    x_range: tuple[float, float] | None = None,
    y_range: tuple[float, float] | None = None,
    steps: int = 41,
    shots: int = 1024,
    threads: int | None = None,
) -> Map:
    """A term of J over two settings round `settings`; the ranges are those of the file unless given, in deg, m and m/s."""
    given, answered = _settings(settings)
    text = problem_of(problem).study.map(
        given,
        x,
        y,
        answered=answered,
        x_range=x_range,
        y_range=y_range,
        steps=steps,
        shots=shots,
        threads=threads,
    )
    return Map.from_json(text, term)


def impact(
    speed: ArrayLike,
    angle: ArrayLike,
    mu_s: ArrayLike,
    mu_d: ArrayLike | None = None,
    restitution: ArrayLike = 0.25,
    *,
    tangential_restitution: ArrayLike = 0.0,
    spin: ArrayLike = 0.0,
    radius: ArrayLike = 0.5e-3,
    density: ArrayLike = 7000.0,
    law: str = "stick_slip",
) -> Table:
    """One oblique impact for each row of broadcast arrays (Zohdi 2015).

    Speed in m/s, angle to the surface in deg, spin in rad/s, radius in m, density in kg/m3; mu_d is 0.9 mu_s unless given.
    The table has normal_impulse (N*, N s), tangential_impulse (f*, N s), the velocities afterwards (m/s), the angle of the
    rebound (deg), the spin (rad/s), energy_ratio, and whether the contact sticks. Rows are in C order of the shape.
    """
    friction = np.asarray(mu_s, dtype=float)
    columns = np.broadcast_arrays(
        np.asarray(speed, dtype=float),
        np.asarray(angle, dtype=float),
        friction,
        0.9 * friction if mu_d is None else np.asarray(mu_d, dtype=float),
        *(np.asarray(it, dtype=float) for it in (restitution, tangential_restitution, spin, radius, density)),
    )
    flat = [np.ascontiguousarray(column).reshape(-1) for column in columns]
    return Table(_core.impact(law, *flat))


def media() -> dict[str, Any]:
    """Shot and contacts that a problem file may `use`, with a source for each number."""
    library: dict[str, Any] = json.loads(_core.media())
    return library


def schema() -> dict[str, Any]:
    """The JSON Schema of problem files."""
    found: dict[str, Any] = json.loads(_core.schema())
    return found


def campaign(
    file: PathLike,
    folder: PathLike,
    *,
    threads: int | None = None,
    progress: Callable[[str, str], object] | None = None,
) -> Table:
    """Plans a campaign, solves what is missing and returns the table: see `peenpose.campaigns` for its parts."""
    campaigns.plan(file, folder)
    campaigns.run(folder, threads=threads, progress=progress)
    return campaigns.gather(folder)
