"""Problem files."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _core
from ._errors import Fault

PathLike = str | os.PathLike[str]
"""A path of a file or a folder."""


def as_yaml(value: object) -> str:
    """A value as it stands in a problem file: texts as they are, all else as JSON, which is YAML."""
    return value if isinstance(value, str) else json.dumps(value)


class Problem:
    """A problem: the text of a problem file, and where its meshes are looked for."""

    def __init__(self, text: str, path: PathLike = "problem.yaml") -> None:
        self._text = text
        self._path = Path(path)
        self._study: _core.Study | None = None

    @classmethod
    def load(cls, path: PathLike) -> Problem:
        """Reads a problem file; faults are told when it is used, or by `check`."""
        return cls(Path(path).read_text(encoding="utf-8-sig"), path)

    @classmethod
    def parse(cls, text: str, path: PathLike = "problem.yaml") -> Problem:
        """A problem from a text; `path` is what messages call it, and meshes are looked for beside it."""
        return cls(text, path)

    @classmethod
    def from_dict(cls, problem: Mapping[str, Any], path: PathLike = "problem.yaml") -> Problem:
        """A problem from nested dictionaries with the keys of a problem file."""
        return cls(json.dumps(problem, indent=2, ensure_ascii=False), path)

    def to_yaml(self) -> str:
        """The text."""
        return self._text

    @property
    def path(self) -> Path:
        """The file that it is read from, or would be."""
        return self._path

    def with_(self, key: str, value: object) -> Problem:
        """The same with another value of a key such as `contacts.dry.restitution`; comments stay.

        Texts are taken as they stand in a file (`"9 m/s"`); numbers, lists and dictionaries do as well.
        """
        return Problem(_core.changed(self._text, [(key, as_yaml(value))]), self._path)

    def check(self) -> list[Fault]:
        """All faults, those of the geometry and the meshes among them; none for a sound problem."""
        return [Fault(*fault) for fault in _core.check(self._text, self._path)]

    def warnings(self) -> list[Fault]:
        """What parses but can hardly be meant."""
        return [Fault(*fault) for fault in self.study.warnings()]

    @property
    def study(self) -> _core.Study:
        """The checked problem with its scene.

        Raises ProblemError where it has faults.
        """
        if self._study is None:
            self._study = _core.Study.from_text(self._text, self._path)
        return self._study

    @property
    def title(self) -> str:
        """Its title."""
        return self.study.title

    @property
    def surfaces(self) -> list[str]:
        """Names of all surfaces of the scene."""
        return self.study.surfaces

    @property
    def contacts(self) -> list[str]:
        """Names of all contacts."""
        return self.study.contacts

    def __repr__(self) -> str:
        return f"Problem({str(self._path)!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Problem) and (self._text, self._path) == (other._text, other._path)

    def __hash__(self) -> int:
        return hash((self._text, self._path))

    def __reduce__(self) -> tuple[type[Problem], tuple[str, str]]:
        return (Problem, (self._text, str(self._path)))


def problem_of(problem: Problem | PathLike) -> Problem:
    """A problem, or that in a file."""
    return problem if isinstance(problem, Problem) else Problem.load(problem)
