from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

_Fault = tuple[int | None, int | None, str, str, str | None, str | None]

class Study:
    @staticmethod
    def from_text(text: str, path: Path) -> Study: ...
    @property
    def title(self) -> str: ...
    @property
    def surfaces(self) -> list[str]: ...
    @property
    def contacts(self) -> list[str]: ...
    def warnings(self) -> list[_Fault]: ...
    def solve(
        self,
        *,
        accuracy: str | None = None,
        seed: int | None = None,
        threads: int | None = None,
        pareto: bool = False,
        evidence: bool = True,
        progress: Callable[[str, int, float | None], object] | None = None,
    ) -> Record: ...
    def evaluate(
        self,
        settings: dict[str, float | str],
        *,
        answered: bool = False,
        shots: int = 16384,
        seed: int | None = None,
        threads: int | None = None,
        evidence: bool = True,
    ) -> Record: ...
    def map(
        self,
        settings: dict[str, float | str],
        x: str,
        y: str,
        *,
        answered: bool = False,
        x_range: tuple[float, float] | None = None,
        y_range: tuple[float, float] | None = None,
        steps: int = 41,
        shots: int = 1024,
        threads: int | None = None,
    ) -> str: ...

class Record:
    @staticmethod
    def from_json(text: str) -> Record: ...
    def to_json(self) -> str: ...
    def sheet(self) -> str: ...
    def brief(self) -> str: ...
    def report_html(self) -> str: ...
    def save(self, folder: Path) -> list[str]: ...
    def hits(self) -> dict[str, NDArray[Any]] | None: ...
    def rebounds(self) -> dict[str, NDArray[Any]] | None: ...

class Objective:
    def __init__(self, study: Study, contact: str, *, shots: int = 1024, penalty: float = 1e6) -> None: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def bounds(self) -> list[tuple[float, float]]: ...
    def __call__(self, x: NDArray[np.float64]) -> NDArray[np.float64]: ...

def check(text: str, path: Path) -> list[_Fault]: ...
def changed(text: str, changes: list[tuple[str, str]]) -> str: ...
def media() -> str: ...
def schema() -> str: ...
def impact(
    law: str,
    speed: NDArray[np.float64],
    angle: NDArray[np.float64],
    mu_s: NDArray[np.float64],
    mu_d: NDArray[np.float64],
    restitution: NDArray[np.float64],
    tangential_restitution: NDArray[np.float64],
    spin: NDArray[np.float64],
    radius: NDArray[np.float64],
    density: NDArray[np.float64],
) -> dict[str, NDArray[Any]]: ...
def campaign_plan(file: Path, folder: Path) -> tuple[int, int]: ...
def campaign_run(
    folder: Path,
    shard: str = "1/1",
    threads: int | None = None,
    progress: Callable[[str, str], object] | None = None,
) -> tuple[int, int, int, int]: ...
def campaign_status(folder: Path) -> tuple[int, int, int]: ...
def campaign_gather(folder: Path) -> str: ...
