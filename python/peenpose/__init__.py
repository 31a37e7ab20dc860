"""Nozzle settings for precision shot peening deep inside keyways, bores and slots.

>>> import peenpose as p
>>> result = p.solve("problems/keyway.yaml")
>>> result.passes, result.best.settings.speed

Angles are in degrees, all else is in SI units.
"""

from . import campaigns
from ._core import __version__
from ._errors import Fault, ProblemError
from ._functions import campaign, evaluate, impact, map, media, schema, solve
from ._map import Map
from ._objective import Objective
from ._problem import Problem
from ._result import Answer, ObjectiveValue, Pose, Result, Settings
from ._table import Table

__all__ = [
    "Answer",
    "Fault",
    "Map",
    "Objective",
    "ObjectiveValue",
    "Pose",
    "Problem",
    "ProblemError",
    "Result",
    "Settings",
    "Table",
    "__version__",
    "campaign",
    "campaigns",
    "evaluate",
    "impact",
    "map",
    "media",
    "schema",
    "solve",
]
