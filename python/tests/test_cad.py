"""From STEP to a technique: the hub of the shipped keyway, drawn with the kernel itself."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import peenpose as p

OCP = pytest.importorskip("OCP")

from peenpose import cad  # noqa: E402


def hub(path: Path, unit: str = "MM") -> None:
    """Writes the 40 mm hub with a 30 mm bore and a groove of 8 mm as STEP, its faces named as in the problem file."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Pnt
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    body = BRepPrimAPI_MakeCylinder(25.0, 40.0).Shape()
    bored = BRepAlgoAPI_Cut(body, BRepPrimAPI_MakeCylinder(15.0, 40.0).Shape()).Shape()
    groove = BRepPrimAPI_MakeBox(gp_Pnt(-4.0, 0.0, 0.0), gp_Pnt(4.0, 18.3, 40.0)).Shape()
    shape = BRepAlgoAPI_Cut(bored, groove).Shape()
    Interface_Static.SetCVal_s("write.step.unit", unit)
    writer = STEPControl_Writer()
    writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(path))
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    # The kernel writes no names of faces by itself: they are put into the text.
    reader, shape, _, _ = cad._read(path)
    model, transfer = reader.WS().Model(), reader.WS().TransferReader()
    entities = [model.Value(number) for number in range(1, model.NbEntities() + 1)]
    names: dict[str, str] = {}
    for face in cad._faces(shape):
        entity = transfer.EntityFromShapeResult(face, 1)
        # What the kernel writes is numbered from 1 on.
        number = next(number for number, it in enumerate(entities, 1) if it is entity)
        names[f"#{number}"] = named(face)
    text = path.read_text()
    for label, name in names.items():
        text = re.sub(rf"({label}\s*=\s*ADVANCED_FACE\s*\()''", rf"\1'{name}'", text)
    path.write_text(text)


def named(face: Any) -> str:
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType

    surface = BRepAdaptor_Surface(face)
    if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder:
        return "bore" if surface.Cylinder().Radius() < 20 else "outer skin"
    axis = surface.Plane().Axis().Direction()
    place = surface.Plane().Location()
    if abs(axis.Z()) > 0.9:
        return ""
    if abs(axis.Y()) > 0.9:
        return "floor"
    return "wall_pos" if place.X() > 0 else "wall_neg"


def test_a_hub_from_step_is_solved_as_the_exact_one(tmp_path: Path, problems: Path, capsys: pytest.CaptureFixture[str]) -> None:
    hub(tmp_path / "hub.step")
    assert cad.main([str(tmp_path / "hub.step"), "--out", str(tmp_path / "hub.obj")]) == 0
    listing = capsys.readouterr().out
    for words in ("floor", "outer_skin", "8 faces, 6 of them named", "unit of the file: millimetre", "hub.obj"):
        assert words in listing, listing
    exact = p.Problem.load(problems / "keyway.yaml")
    text = re.sub(r"keyway: \{[^}]*\}", "mesh: hub.obj", exact.to_yaml())
    meshed = p.Problem.parse(text, tmp_path / "keyway.yaml")
    assert meshed.check() == []
    assert {"hub.floor", "hub.wall_neg", "hub.wall_pos", "hub.bore", "hub.outer_skin"} < set(meshed.surfaces)
    ours = next(it for it in p.solve(exact).answers if it.settings.contact == "oiled")
    theirs = p.evaluate(meshed, ours.settings, shots=65_536).best
    same = p.evaluate(exact, ours.settings, shots=65_536).best
    assert theirs.objective is not None and same.objective is not None
    assert theirs.objective.total == pytest.approx(same.objective.total, rel=0.01)
    solved = next(it for it in p.solve(meshed, evidence=False).answers if it.settings.contact == "oiled")
    assert solved.objective is not None and ours.objective is not None
    assert solved.objective.total == pytest.approx(ours.objective.total, rel=0.01)


def test_units_faces_and_deflection(tmp_path: Path) -> None:
    hub(tmp_path / "hub.step")
    hub(tmp_path / "inch.step", "INCH")
    fine = cad.convert(tmp_path / "hub.step", tmp_path / "hub.obj", deflection="1 um")
    coarse = cad.convert(tmp_path / "inch.step", tmp_path / "inch.obj", deflection=0.1, angle=30)
    assert (fine.unit, coarse.unit) == ("millimetre", "inch")
    by_name = {face.name: face for face in coarse.faces}
    floor = by_name["floor"]
    assert (floor.form, floor.radius) == ("plane", None)
    assert floor.area == pytest.approx(320, rel=1e-6)
    assert floor.normal == pytest.approx((0, -1, 0), abs=1e-9)
    assert floor.low + floor.high == pytest.approx((-4, 18.3, 0, 4, 18.3, 40), abs=1e-6)
    assert by_name["bore"].radius == pytest.approx(15)
    unnamed = [face.name for face in coarse.faces if not face.named]
    assert len(unnamed) == 2 and all(name.startswith("face_") for name in unnamed)
    assert sum(face.triangles for face in fine.faces) > 2 * sum(face.triangles for face in coarse.faces)
    # Corners lie on the surface, so chords are within the deflection.
    points = [tuple(map(float, line.split()[1:])) for line in (tmp_path / "hub.obj").read_text().splitlines() if line.startswith("v ")]
    radii = [(x * x + y * y) ** 0.5 for x, y, _ in points]
    assert any(abs(radius - 25) < 1e-6 for radius in radii)
    assert coarse.table["surface"].tolist() == [face.name for face in coarse.faces]


def test_a_name_that_all_faces_have_names_none(tmp_path: Path) -> None:
    hub(tmp_path / "hub.step")
    text = (tmp_path / "hub.step").read_text()
    (tmp_path / "body.step").write_text(re.sub(r"ADVANCED_FACE\s*\('[^']*'", "ADVANCED_FACE('PartBody'", text))
    found = cad.convert(tmp_path / "body.step", tmp_path / "body.obj")
    assert [face.name for face in found.faces] == [f"face_{number}" for number in range(1, 9)]
    assert "`PartBody` names 8 of 8 faces" in found.skipped[0]


def test_what_is_no_step_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "text.step").write_text("solid\n")
    for arguments, word in [
        ([tmp_path / "none.step"], "no such file"),
        ([tmp_path / "text.step"], "cannot read it as STEP"),
        ([tmp_path / "text.step", "--deflection", "3 furlong"], "is no length"),
        ([tmp_path / "text.step", "--deflection", "0 mm"], "above 0"),
        ([tmp_path / "text.step", "--angle", "90"], "less than 90"),
    ]:
        assert cad.main([*map(str, arguments), "--out", str(tmp_path / "x.obj")]) == 2
        assert word in capsys.readouterr().err
        assert not (tmp_path / "x.obj").exists()
