"""Columns of equal length, as numpy arrays, for pandas, polars and whatever else reads Arrow."""

from __future__ import annotations

import html
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

_MOST_SHOWN = 20


class Table(Mapping[str, NDArray[Any]]):
    """A table: a mapping from names of columns to arrays."""

    def __init__(self, columns: Mapping[str, NDArray[Any]]) -> None:
        self._columns = dict(columns)

    @classmethod
    def of_rows(cls, rows: list[dict[str, Any]]) -> Table:
        """A table from rows with the same keys; None becomes nan in columns of numbers."""
        names = list(rows[0]) if rows else []
        return cls({name: _column([row.get(name) for row in rows]) for name in names})

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Table) or list(self) != list(other):
            return False
        return all(
            np.array_equal(column, other[name], equal_nan=column.dtype.kind == "f")
            for name, column in self._columns.items()
        )

    __hash__ = None  # type: ignore[assignment]

    @property
    def rows(self) -> int:
        """How many rows it has."""
        return len(next(iter(self._columns.values()), ()))

    def to_pandas(self) -> Any:
        """A pandas.DataFrame on the same memory."""
        import pandas

        return pandas.DataFrame(self._columns, copy=False)

    def to_polars(self) -> Any:
        """A polars.DataFrame."""
        import polars

        return polars.DataFrame(self)

    def to_parquet(self, path: str) -> None:
        """Writes it as Parquet; needs pyarrow."""
        import pyarrow
        import pyarrow.parquet

        pyarrow.parquet.write_table(pyarrow.table(self), path)

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        from arro3.core import Array, DataType, Field, Schema, Table as ArrowTable

        arrays = [
            Array([str(it) for it in column], DataType.utf8())
            if column.dtype == object
            else Array.from_numpy(np.ascontiguousarray(column))
            for column in self._columns.values()
        ]
        fields = [Field(name, array.type) for name, array in zip(self, arrays, strict=True)]
        table = ArrowTable.from_arrays(arrays, schema=Schema(fields))
        stream: object = table.__arrow_c_stream__(requested_schema)
        return stream

    def _cells(self) -> list[list[str]]:
        def text(value: Any) -> str:
            return f"{value:.6g}" if isinstance(value, float | np.floating) else str(value)

        shown = range(min(self.rows, _MOST_SHOWN))
        return [[text(column[row]) for column in self._columns.values()] for row in shown]

    def __repr__(self) -> str:
        cells = [list(self), *self._cells()]
        widths = [max(len(row[column]) for row in cells) for column in range(len(self))]
        lines = ["  ".join(map(str.ljust, row, widths)).rstrip() for row in cells]
        more = self.rows - _MOST_SHOWN
        return "\n".join(lines + ([f"... {more} more rows"] if more > 0 else []))

    def _repr_html_(self) -> str:
        def line(tag: str, row: list[str]) -> str:
            return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in row) + "</tr>"

        body = "".join(line("td", row) for row in self._cells())
        more = self.rows - _MOST_SHOWN
        rest = f"<p>... {more} more rows</p>" if more > 0 else ""
        return f"<table><thead>{line('th', list(self))}</thead><tbody>{body}</tbody></table>{rest}"


def _column(values: list[Any]) -> NDArray[Any]:
    if all(isinstance(value, bool) for value in values):
        return np.array(values, dtype=bool)
    if all(value is None or isinstance(value, int | float) for value in values):
        return np.array([np.nan if value is None else value for value in values], dtype=float)
    return np.array(["" if value is None else value for value in values], dtype=object)
