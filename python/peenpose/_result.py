"""Results."""

from __future__ import annotations

import html
import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from . import _core
from ._problem import PathLike
from ._table import Table

_UNITS = ("_deg", "_m_s", "_m")


def _without_unit(key: str) -> str:
    for unit in _UNITS:
        if key.endswith(unit):
            return key.removesuffix(unit)
    return key


@dataclass(frozen=True)
class Settings:
    """What the machine is set to: angles in deg, lengths in m, speed in m/s."""

    incidence: float
    """Impingement angle; 90 is perpendicular."""
    azimuth: float
    """Direction in the target plane; 0 is along `target.along`."""
    standoff: float
    """From the aim point back to the exit."""
    speed: float
    """Of the shot at the exit."""
    aim_along: float
    """Shift of the aim point along azimuth 0."""
    aim_across: float
    """Shift across it."""
    aim_above: float
    """Shift away from the target."""
    contact: str
    """Name of the contact."""
    mu_s: float
    """Its static friction."""

    def to_dict(self) -> dict[str, float | str]:
        """As `evaluate` takes them."""
        return dict(self.__dict__)


@dataclass(frozen=True)
class Pose:
    """Where the nozzle stands, in the coordinates of the file."""

    exit: tuple[float, float, float]
    """Middle of the exit, m."""
    direction: tuple[float, float, float]
    """Unit vector along the jet."""
    quaternion: tuple[float, float, float, float]
    """x, y, z, w; takes z to the direction of the jet."""
    matrix: tuple[tuple[float, float, float, float], ...]
    """The same as a 4x4 matrix, m."""


@dataclass(frozen=True)
class ObjectiveValue:
    """J and its weighted terms."""

    total: float
    standard_error: float
    normal_impulse: float
    tangential_impulse: float
    rebound: float
    miss: float


@dataclass(frozen=True)
class Answer:
    """Settings and what they do."""

    settings: Settings
    pose: Pose
    passes: bool
    """Whether every verdict passes."""
    feasible: bool
    """Whether the nozzle fits."""
    objective: ObjectiveValue | None
    """None where the nozzle does not fit."""
    clearance: float | None
    """Distance between nozzle and part as it is set, m."""
    verdicts: Table
    """A row for each goal and each surface."""


def _answer(answer: dict[str, Any]) -> Answer:
    settings = {_without_unit(key): value for key, value in answer["settings"].items()}
    pose = answer["pose"]
    objective = answer["objective"]
    return Answer(
        settings=Settings(
            **settings, contact=answer["contact"], mu_s=answer["contact_values"]["mu_s"]
        ),
        pose=Pose(
            exit=tuple(pose["exit_m"]),
            direction=tuple(pose["direction"]),
            quaternion=tuple(pose["quaternion_xyzw"]),
            matrix=tuple(tuple(row) for row in pose["matrix_4x4"]),
        ),
        passes=answer["passes"],
        feasible=answer["feasible"],
        objective=objective
        and ObjectiveValue(
            **{name: objective[name] for name in ObjectiveValue.__dataclass_fields__}
        ),
        clearance=answer["clearance_m"],
        verdicts=_verdicts(answer["verdicts"]),
    )


def _verdicts(verdicts: list[dict[str, Any]]) -> Table:
    rows = [
        {
            "subject": verdict["subject"],
            "passes": verdict["passes"],
            "share": verdict["share"],
            "share_low": verdict["interval_95"][0],
            "share_high": verdict["interval_95"][1],
            "allowed": verdict["allowed"],
            "counted": verdict["counted"],
            "certain": verdict["certain"],
        }
        for verdict in verdicts
    ]
    return Table.of_rows(rows)


class Result:
    """What came of a problem. It is pickled, shown in notebooks, and written with all reports by `save`."""

    def __init__(self, record: _core.Record) -> None:
        self._record = record

    @classmethod
    def from_json(cls, text: str) -> Result:
        """From the text of a result.json."""
        return cls(_core.Record.from_json(text))

    @classmethod
    def load(cls, path: PathLike) -> Result:
        """From a folder that `save` or `peenpose solve --out` has written, or from its result.json."""
        path = Path(path)
        file = path / "result.json" if path.is_dir() else path
        return cls.from_json(file.read_text(encoding="utf-8"))

    def to_json(self) -> str:
        """The text of result.json, to the last bit that of `peenpose solve --json` but for the times."""
        return self._record.to_json()

    @cached_property
    def _json(self) -> dict[str, Any]:
        record: dict[str, Any] = json.loads(self.to_json())
        return record

    def to_dict(self) -> dict[str, Any]:
        """Everything that is in result.json."""
        record: dict[str, Any] = json.loads(self.to_json())
        return record

    @property
    def status(self) -> str:
        """`converged`, `best_found`, `no_feasible_pose`, `interrupted` or `evaluated`."""
        return str(self._json["status"])

    @property
    def passes(self) -> bool:
        """Whether every verdict on the best settings passes."""
        return self.best.passes

    @cached_property
    def best(self) -> Answer:
        """The recommended settings."""
        return _answer(self._json["best"])

    @cached_property
    def answers(self) -> list[Answer]:
        """The best settings of each contact, best first."""
        return [_answer(answer) for answer in self._json["choices"]]

    @property
    def verdicts(self) -> Table:
        """Verdicts on the best settings."""
        return self.best.verdicts

    @cached_property
    def choices(self) -> Table:
        """A row for the best settings of each contact, best first."""
        rows = []
        for answer in self.answers:
            value = answer.objective
            rows.append(
                {
                    **answer.settings.__dict__,
                    "passes": answer.passes,
                    "feasible": answer.feasible,
                    "objective": value and value.total,
                    "objective_standard_error": value and value.standard_error,
                }
            )
        return Table.of_rows(rows)

    @cached_property
    def windows(self) -> Table:
        """How far each setting can change until a verdict fails, and which."""
        rows = [
            {
                "setting": window["setting"],
                "low": window["down"]["to"],
                "low_turns": window["down"]["turns"] or "",
                "high": window["up"]["to"],
                "high_turns": window["up"]["turns"] or "",
            }
            for window in self._json["windows"]
        ]
        return Table.of_rows(rows)

    @cached_property
    def surfaces(self) -> Table:
        """What each secondary surface receives."""
        rows = []
        for name, receipt in self._json["best"]["surfaces"].items():
            spread = receipt["normal_impulse_N_s"] or {}
            rows.append(
                {
                    "surface": name,
                    "share_of_shots": receipt["share_of_shots"],
                    "share_over": receipt["share_over"],
                    "allow": receipt["allow_N_s"],
                    "mean": spread.get("mean"),
                    "largest": spread.get("largest"),
                }
            )
        return Table.of_rows(rows)

    @cached_property
    def hits(self) -> Table:
        """First hits on the target: places in m, angles in deg, impulses in N s; empty without evidence."""
        return Table(self._record.hits() or {})

    @cached_property
    def rebounds(self) -> Table:
        """Impacts on secondary surfaces; empty without evidence."""
        return Table(self._record.rebounds() or {})

    @property
    def stroke(self) -> dict[str, Any] | None:
        """The program of a stroke as it stands in result.json; None for a spot."""
        return self._json.get("stroke")

    @cached_property
    def sheet(self) -> str:
        """The technique sheet."""
        return self._record.sheet()

    def report_html(self) -> str:
        """The page with the scene in three dimensions."""
        return self._record.report_html()

    def save(self, folder: PathLike) -> list[str]:
        """Writes result.json and all reports into a folder; returns their names."""
        return self._record.save(Path(folder))

    def __repr__(self) -> str:
        return self._record.brief().rstrip()

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        page = html.escape(self.report_html(), quote=True)
        frame = f'<iframe srcdoc="{page}" style="width:100%;height:640px;border:0"></iframe>'
        return {"text/plain": self.sheet, "text/html": frame}

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return (Result.from_json, (self.to_json(),))
