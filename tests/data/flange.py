#!/usr/bin/env python3
"""A flange with a hub, as a CAD kernel writes it: binary STL, single precision, needles and fans.

    python flange.py            # writes flange.stl beside this script

Needs cadquery (made with 2.8.0 on Python 3.11): pip install cadquery==2.8.0

Rays are tested in it, so it has what is hard for them: long strips on the cylinders, fans of needles on
the plane faces that the holes cut, facets of all sizes on fillets that run into each other. Lengths are mm.
"""

from pathlib import Path

import cadquery as cq

PLATE = 90.0            # diameter
THICKNESS = 9.0
HUB = 46.0              # diameter
HEIGHT = 34.0           # over all
BORE = 28.0
KEY_WIDTH, KEY_TOP = 8.0, 17.3
BOLTS, PITCH = 7, 70.0  # an odd number, so that nothing is symmetric
HOLE, HEAD, HEAD_DEPTH = 6.6, 11.0, 4.3
FILLET = 3.0


def flange():
    part = cq.Workplane("XY").circle(PLATE / 2).extrude(THICKNESS)
    part = part.faces(">Z").workplane().circle(HUB / 2).extrude(HEIGHT - THICKNESS)
    part = part.faces("<Z[1]").edges("%CIRCLE").edges(cq.selectors.RadiusNthSelector(0)).fillet(FILLET)
    part = part.faces(">Z").edges().fillet(1.5)
    part = part.cut(cq.Workplane("XY").circle(BORE / 2).extrude(HEIGHT))
    key = cq.Workplane("XY").rect(KEY_WIDTH, 2 * KEY_TOP).extrude(HEIGHT).edges("|Z").fillet(0.4)
    part = part.cut(key.intersect(cq.Workplane("XY").box(100, 100, 200).translate((0, 50, 0))))
    on_pitch = cq.Workplane("XY").polarArray(PITCH / 2, 0, 360, BOLTS)
    part = part.cut(on_pitch.circle(HOLE / 2).extrude(THICKNESS))
    heads = cq.Workplane("XY", origin=(0, 0, THICKNESS - HEAD_DEPTH)).polarArray(PITCH / 2, 0, 360, BOLTS)
    part = part.cut(heads.circle(HEAD / 2).extrude(HEAD_DEPTH))
    oil = cq.Workplane("YZ", origin=(0, 0, 22)).circle(1.5).extrude(HUB)
    part = part.cut(oil)
    solid = part.val()
    if isinstance(solid, cq.Compound):
        (solid,) = solid.Solids()
    assert solid.isValid() and len(solid.Shells()) == 1
    return solid


if __name__ == "__main__":
    path = Path(__file__).resolve().with_name("flange.stl")
    solid = flange()
    solid.exportStl(str(path), tolerance=0.02, angularTolerance=0.2)
    print(f"{path.name}: {path.stat().st_size} bytes, CAD volume {solid.Volume():.3f} mm3")
