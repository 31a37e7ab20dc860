"""Campaigns: many problems from one, solved in shards by whoever has time, and gathered in a table."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from . import _core
from ._problem import PathLike
from ._table import Table


@dataclass(frozen=True)
class Outcome:
    """What a run has come to: how many cases were solved, have faults, were there before, and are left."""

    solved: int
    faulty: int
    kept: int
    left: int


@dataclass(frozen=True)
class Status:
    """How many cases are done, missing and faulty."""

    done: int
    missing: int
    faulty: int

    @property
    def cases(self) -> int:
        """How many there are."""
        return self.done + self.missing + self.faulty


def plan(file: PathLike, folder: PathLike) -> int:
    """Plans the cases of a campaign file into a folder; returns how many there are."""
    cases, _ = _core.campaign_plan(Path(file), Path(folder))
    return cases


def run(
    folder: PathLike,
    shard: str = "1/1",
    *,
    threads: int | None = None,
    progress: Callable[[str, str], object] | None = None,
) -> Outcome:
    """Solves the cases of a shard that are missing; `progress` is called with the name of each case and its status."""
    return Outcome(*_core.campaign_run(Path(folder), shard, threads, progress))


def status(folder: PathLike) -> Status:
    """What has come of a campaign so far."""
    return Status(*_core.campaign_status(Path(folder)))


def gather_csv(folder: PathLike) -> str:
    """The table as CSV, byte for byte that of `peenpose campaign gather`."""
    return _core.campaign_gather(Path(folder))


def gather(folder: PathLike) -> Table:
    """The table: a row for each case, in the order of the plan. Columns of numbers have nan where there is no result."""
    rows = list(csv.DictReader(io.StringIO(gather_csv(folder))))
    for row in rows:
        for name, cell in row.items():
            row[name] = _number(cell)
    return Table.of_rows([dict(row) for row in rows])


def _number(cell: str) -> str | float | None:
    if cell == "":
        return None
    try:
        return float(cell)
    except ValueError:
        return cell
