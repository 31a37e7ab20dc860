"""Where the shipped problems are, and the program inside the wheel."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def problems() -> Path:
    return ROOT / "problems"


@pytest.fixture
def program() -> Path:
    """The command that the wheel has installed."""
    return Path(sys.executable).with_name("peenpose")
