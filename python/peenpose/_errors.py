"""What is wrong with a problem."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

FaultTuple = tuple[int | None, int | None, str, str, str | None, str | None]


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong with a problem file, or that can hardly be meant."""

    line: int | None
    """Line of the text, from 1; None where no place is known."""
    column: int | None
    """Column in characters, from 1."""
    key: str
    """Key path, such as `scene.hub.keyway.width`; empty for the file as a whole."""
    message: str
    """What is wrong."""
    expected: str | None
    """What should stand there instead."""
    proposal: str | None
    """The nearest valid name or value."""

    def __str__(self) -> str:
        place = "" if self.line is None else f"{self.line}:{self.column}: "
        key = f"{self.key}: " if self.key else ""
        expected = "" if self.expected is None else f"; expected {self.expected}"
        proposal = "" if self.proposal is None else f"; did you mean `{self.proposal}`?"
        return f"{place}{key}{self.message}{expected}{proposal}"


class ProblemError(ValueError):
    """A problem with faults: all of them, each with its place."""

    def __init__(self, text: str, faults: list[Fault]) -> None:
        super().__init__(text)
        self.faults = faults
        """All faults, in the order of the text."""

    @classmethod
    def of_tuples(cls, text: str, faults: Iterable[FaultTuple]) -> ProblemError:
        return cls(text, [Fault(*fault) for fault in faults])

    def __reduce__(self) -> tuple[type[ProblemError], tuple[str, list[Fault]]]:
        return (type(self), (str(self), self.faults))
