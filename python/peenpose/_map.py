"""Maps: a term of the objective over two settings."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

TERMS = ("total", "normal_impulse", "tangential_impulse", "rebound", "miss")


@dataclass(frozen=True)
class Map:
    """A term over two settings, all others held."""

    x: NDArray[np.float64]
    """Values of the lower axis, deg, m or m/s."""
    y: NDArray[np.float64]
    """Values of the left axis."""
    values: NDArray[np.float64]
    """The term, shape (len(y), len(x)); nan where the nozzle does not fit."""
    passes: NDArray[np.bool_]
    """Where every verdict passes, of the same shape."""
    x_name: str
    y_name: str
    term: str
    shots: int

    @classmethod
    def from_json(cls, text: str, term: str) -> Map:
        if term not in TERMS:
            raise ValueError(f"there is no term `{term}`; expected one of {', '.join(TERMS)}")
        record: dict[str, Any] = json.loads(text)
        x, y = (np.array(record[axis]["values"], dtype=float) for axis in "xy")

        def value(cell: dict[str, Any]) -> float:
            terms = cell["terms"]
            if terms is None:
                return float("nan")
            return float(sum(terms) if term == "total" else terms[TERMS.index(term) - 1])

        shape = (len(y), len(x))
        cells = record["cells"]
        return cls(
            x=x,
            y=y,
            values=np.array([value(cell) for cell in cells]).reshape(shape),
            passes=np.array(
                [cell["terms"] is not None and not cell["fails"] for cell in cells]
            ).reshape(shape),
            x_name=record["x"]["setting"],
            y_name=record["y"]["setting"],
            term=term,
            shots=record["shots"],
        )

    def to_xarray(self) -> Any:
        """An xarray.Dataset with the term and `passes`."""
        import xarray

        axes = (self.y_name, self.x_name)
        return xarray.Dataset(
            {self.term: (axes, self.values), "passes": (axes, self.passes)},
            coords={self.x_name: self.x, self.y_name: self.y},
            attrs={"shots": self.shots},
        )
