"""CAD: from a STEP file to a mesh whose surfaces have the names of the faces.

Needs `pip install 'peenpose[cad]'`, which brings Open CASCADE. The command is `peenpose-cad part.step --out part.obj`.
"""

from __future__ import annotations

import argparse
import math
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ._problem import PathLike
from ._table import Table

_UNITS = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}


class CadError(ValueError):
    """A file of which no mesh can be made."""


@dataclass(frozen=True)
class Face:
    """A face of the part; lengths in mm."""

    name: str
    """The surface that it becomes: its own name, or `face_12`."""
    named: bool
    """Whether it has a name in the file."""
    form: str
    """plane, cylinder, cone, sphere, torus, or the kernel's word for what is none of these."""
    radius: float | None
    """Of a cylinder, sphere or torus (the small one)."""
    area: float
    """mm2."""
    low: tuple[float, float, float]
    """Smallest coordinates."""
    high: tuple[float, float, float]
    """Largest coordinates."""
    normal: tuple[float, float, float]
    """Unit normal in its middle, out of the material."""
    triangles: int


@dataclass(frozen=True)
class Converted:
    """What was written."""

    faces: list[Face]
    unit: str
    """Unit of the STEP file; the mesh is in mm."""
    deflection: float
    """How far triangles may be from the surface, mm."""
    skipped: list[str] = field(default_factory=list)
    """What the kernel could not read or mesh, and names that tell nothing."""

    @property
    def table(self) -> Table:
        """A row for each face."""
        rows = [
            {
                "surface": face.name,
                "form": face.form,
                "radius": face.radius,
                "area": face.area,
                **{f"{axis}_min": value for axis, value in zip("xyz", face.low, strict=True)},
                **{f"{axis}_max": value for axis, value in zip("xyz", face.high, strict=True)},
                **{f"normal_{axis}": value for axis, value in zip("xyz", face.normal, strict=True)},
                "triangles": face.triangles,
            }
            for face in self.faces
        ]
        return Table.of_rows(rows)


def convert(step: PathLike, out: PathLike, *, deflection: float | str = "0.01 mm", angle: float = 5.0) -> Converted:
    """Writes the part in a STEP file as an OBJ with a group for each face, in mm.

    Triangles are within `deflection` (mm, or a text with a unit) of the surface, and turn by at most `angle` (deg) from one
    to the next. Faces with the same name become one surface.

    Raises CadError where the kernel cannot read the file.
    """
    step, out = Path(step), Path(out)
    gap = _millimetres(deflection)
    if not (gap > 0 and math.isfinite(gap)):
        raise CadError(f"deflection {deflection}: expected a length above 0")
    if not 0 < angle < 90:
        raise CadError(f"angle {angle}: expected more than 0 and less than 90 deg")
    if not step.is_file():
        raise CadError(f"{step}: there is no such file")
    reader, shape, unit, skipped = _read(step)
    from OCP.BRepMesh import BRepMesh_IncrementalMesh

    BRepMesh_IncrementalMesh(shape, gap, False, math.radians(angle), True)
    transfer = reader.WS().TransferReader()
    lines = [
        f"# {step.name}, made by peenpose-cad",
        f"# lengths in mm; triangles within {gap:g} mm of the surface and {angle:g} deg of each other",
        f"# deflection {gap:g}",
    ]
    faces: list[Face] = []
    first = 1
    found = [(face, _name(transfer.EntityFromShapeResult(face, 1))) for face in _faces(shape)]
    # Some kernels give all faces the name of their body.
    (common, count), *_ = [*Counter(name for _, name in found if name is not None).most_common(1), ("", 0)]
    if count > 1 and 2 * count > len(found):
        skipped.append(f"`{common}` names {count} of {len(found)} faces and tells none of them apart: they are numbered")
        found = [(face, None if name == common else name) for face, name in found]
    for number, (face, own) in enumerate(found, 1):
        name = own or f"face_{number}"
        mesh = _triangles(face)
        if mesh is None:
            skipped.append(f"{name}: the kernel made no triangles of it")
            continue
        points, triangles = mesh
        lines.append(f"g {name}")
        # Enough digits for equal points to stay equal where faces meet.
        lines.extend(f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points)
        lines.extend("f " + " ".join(str(first + corner) for corner in corners) for corners in triangles)
        first += len(points)
        faces.append(_described(face, name, own is not None, points, len(triangles)))
    if not faces:
        raise CadError(f"{step}: no face of it could be meshed")
    out.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return Converted(faces, unit, gap, skipped)


def _millimetres(length: float | str) -> float:
    if not isinstance(length, str):
        return float(length)
    found = re.fullmatch(r"\s*([0-9.eE+-]+)\s*([a-z]+)\s*", length)
    if found is None or found[2] not in _UNITS:
        raise CadError(f"`{length}` is no length such as `0.01 mm`")
    try:
        return float(found[1]) * _UNITS[found[2]]
    except ValueError:
        raise CadError(f"`{length}` is no length such as `0.01 mm`") from None


def _read(step: Path) -> tuple[Any, Any, str, list[str]]:
    try:
        from OCP.IFSelect import IFSelect_ReturnStatus
        from OCP.STEPControl import STEPControl_Reader
    except ImportError as error:
        raise CadError("this needs Open CASCADE: pip install 'peenpose[cad]'") from error
    reader = STEPControl_Reader()
    if reader.ReadFile(str(step)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise CadError(f"{step}: the kernel cannot read it as STEP")
    skipped: list[str] = []
    roots = reader.NbRootsForTransfer()
    for root in range(1, roots + 1):
        if not reader.TransferRoot(root):
            skipped.append(f"root {root} of {roots}: the kernel made no shape of it")
    if reader.NbShapes() == 0:
        raise CadError(f"{step}: there is no shape in it")
    return reader, reader.OneShape(), _unit(step), skipped


def _unit(step: Path) -> str:
    """The unit of length of a STEP file in words; the kernel has converted it to mm."""
    text = step.read_text(encoding="latin-1")
    # A conversion-based unit, such as INCH, refers to millimetres as well.
    based = re.search(r"CONVERSION_BASED_UNIT\s*\(\s*'([^']*)'[^;]*LENGTH_UNIT|LENGTH_UNIT[^;]*CONVERSION_BASED_UNIT\s*\(\s*'([^']*)'", text)
    if based:
        return (based[1] or based[2]).lower()
    prefixed = re.search(r"LENGTH_UNIT[^;]*SI_UNIT\s*\(\s*(?:\.(\w+)\.|\$)\s*,\s*\.METRE\.", text)
    return f"{(prefixed[1] or '').lower()}metre" if prefixed else "unknown"


def _faces(shape: Any) -> Iterator[Any]:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    cast = getattr(TopoDS, "Face_s", None) or TopoDS.Face
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        yield cast(explorer.Current())
        explorer.Next()


def _name(entity: Any) -> str | None:
    """The name of a face as a problem file can write it; None where it has none that tells anything."""
    own = getattr(entity, "Name", lambda: None)()
    text = own.ToCString().strip() if own is not None else ""
    name = re.sub(r"[^A-Za-z0-9_-]+", "_", text).strip("_")
    # What some kernels write where there is no name.
    return None if name == "" or name.upper() in ("NONE", "FACE", "ADVANCED_FACE") else name


def _triangles(face: Any) -> tuple[list[tuple[float, float, float]], list[tuple[int, int, int]]] | None:
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopLoc import TopLoc_Location

    place = TopLoc_Location()
    mesh = BRep_Tool.Triangulation_s(face, place)
    if mesh is None:
        return None
    moved = place.Transformation()
    nodes = (mesh.Node(index).Transformed(moved) for index in range(1, mesh.NbNodes() + 1))
    points = [(point.X(), point.Y(), point.Z()) for point in nodes]
    turned = face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
    triangles = []
    for index in range(1, mesh.NbTriangles() + 1):
        a, b, c = (mesh.Triangle(index).Value(corner) - 1 for corner in (1, 2, 3))
        triangles.append((a, c, b) if turned else (a, b, c))
    return points, triangles


def _described(face: Any, name: str, named: bool, points: list[tuple[float, float, float]], triangles: int) -> Face:
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.BRepGProp import BRepGProp
    from OCP.gp import gp_Pnt, gp_Vec
    from OCP.GProp import GProp_GProps
    from OCP.TopAbs import TopAbs_Orientation

    surface = BRepAdaptor_Surface(face)
    form = str(surface.GetType()).rpartition("_")[2].rpartition(".")[2].lower()
    radius = {
        "cylinder": lambda: surface.Cylinder().Radius(),
        "sphere": lambda: surface.Sphere().Radius(),
        "torus": lambda: surface.Torus().MinorRadius(),
    }.get(form, lambda: None)()
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face, properties)
    u = (surface.FirstUParameter() + surface.LastUParameter()) / 2
    v = (surface.FirstVParameter() + surface.LastVParameter()) / 2
    point, along, across = gp_Pnt(), gp_Vec(), gp_Vec()
    surface.D1(u, v, point, along, across)
    normal = along.Crossed(across)
    length = normal.Magnitude() or 1.0
    if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
        length = -length
    columns = list(zip(*points, strict=True))
    low, high = (tuple(of(column) for column in columns) for of in (min, max))
    return Face(
        name=name,
        named=named,
        form=form,
        radius=radius,
        area=properties.Mass(),
        low=(low[0], low[1], low[2]),
        high=(high[0], high[1], high[2]),
        normal=(normal.X() / length, normal.Y() / length, normal.Z() / length),
        triangles=triangles,
    )


def _listing(converted: Converted, out: Path) -> str:
    def listed(numbers: tuple[float, float, float]) -> str:
        return " ".join(f"{0.0 if abs(number) < 5e-5 else number:.5g}" for number in numbers)

    heading = ["surface", "form", "radius", "area mm2", "x y z from", "to", "normal"]
    rows = [
        [
            face.name,
            face.form,
            "" if face.radius is None else f"{face.radius:.5g}",
            f"{face.area:.4g}",
            listed(face.low),
            listed(face.high),
            listed(face.normal),
        ]
        for face in converted.faces
    ]
    widths = [max(len(row[column]) for row in [heading, *rows]) for column in range(len(heading))]
    lines = ["  ".join(map(str.ljust, row, widths)).rstrip() for row in [heading, *rows]]
    part = out.stem
    name = converted.faces[0].name
    named = sum(face.named for face in converted.faces)
    lines += [
        "",
        f"{len(converted.faces)} faces, {named} of them named; unit of the file: {converted.unit}; "
        f"within {converted.deflection:g} mm of the surface",
        f"in a problem file: scene: {{ {part}: {{ mesh: {out.name}, lengths_in: mm }} }}, "
        f"target: {{ surface: {part}.{name} }}",
    ]
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """The command `peenpose-cad`; its status is 2 where no mesh can be made."""
    parser = argparse.ArgumentParser(prog="peenpose-cad", description="From a STEP file to an OBJ with named surfaces.")
    parser.add_argument("step", type=Path, help="the STEP file")
    parser.add_argument("--out", type=Path, required=True, help="the OBJ that is written, in mm")
    parser.add_argument("--deflection", default="0.01 mm", help="how far triangles may be from the surface (0.01 mm)")
    parser.add_argument("--angle", type=float, default=5.0, help="by how much neighbours may turn, deg (5)")
    given = parser.parse_args(arguments)
    try:
        converted = convert(given.step, given.out, deflection=given.deflection, angle=given.angle)
    except (CadError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(_listing(converted, given.out))
    for note in converted.skipped:
        print(f"warning: {note}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
