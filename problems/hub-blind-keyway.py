#!/usr/bin/env python3
"""A shaft hub whose bore carries a blind keyway: CAD model and mesh for peenpose.

    python hub-blind-keyway.py            # writes hub-blind-keyway.obj beside this script
    python hub-blind-keyway.py --step     # and hub-blind-keyway.step

Needs cadquery (made with 2.8.0 on Python 3.11): pip install cadquery==2.8.0

Axes: the bore lies along z, from 0 to the hub's length. The keyway is sunk into the bore
wall towards +y and is symmetric about x = 0. Lengths are millimetres.

          y                           seen along x, the hub cut open at x = 0
          ^   ______________________________________________
          |  |                    hub                       |
     18.3 |  |            ________________________          |   <- floor
     15   |  |___________|                        |_________|   <- bore wall
          |  /  chamfer   near end         far end          \\
          +--------------------------------------------------> z

Every face of the solid gets a name from its geometry alone (not from its number in the
kernel, which changes with every edit), and becomes a group of the OBJ file.
"""

import argparse
import math
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import cadquery as cq
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.TopAbs import TopAbs_REVERSED
from OCP.TopLoc import TopLoc_Location


@dataclass(frozen=True)
class Hub:
    """Dimensions in mm. Width and depth are DIN 6885-1, key 8 x 7, in a 30 mm bore; the root is rounder
    than the norm's 0.16 to 0.25, for a part that is meant to be peened."""

    bore: float = 30.0            # diameter
    outside: float = 50.0         # diameter
    length: float = 60.0
    chamfer: float = 1.0          # of both bore edges, 45 degrees
    key_width: float = 8.0
    key_depth: float = 3.3        # floor below the crown of the bore (t2)
    key_length: float = 32.0      # over all, round ends included
    key_start: float = 18.0       # z where the pocket begins
    root_radius: float = 0.4      # between floor and walls, all round

    @property
    def floor_y(self):
        return self.bore / 2 + self.key_depth

    @property
    def key_centre_z(self):
        return self.key_start + self.key_length / 2

    @property
    def end_radius(self):
        """Of the round ends in plan view: that of the cutter, half the width."""
        return self.key_width / 2

    def check(self):
        assert self.chamfer < self.key_start, "the pocket would run into the near chamfer"
        assert self.key_start + self.key_length < self.length - self.chamfer, "... far chamfer"
        assert self.key_length > self.key_width, "the pocket has no straight part"
        assert self.root_radius < self.end_radius, "the root leaves no floor at the ends"
        assert self.floor_y < self.outside / 2, "the pocket breaks through the hub"


# How finely the surfaces are approximated. The sag is a fraction of the size of each edge; it governs
# the long edges (bore: below 2 degrees per facet), and the angle the short ones (root: the kernel
# halves it, about 3 degrees per facet).
SAG = 0.0001
ANGLE = math.radians(6.0)


def build(hub):
    """The solid: a turned blank, then one pass of the end mill."""
    hub.check()
    blank = (
        cq.Workplane("XY")
        .circle(hub.outside / 2)
        .circle(hub.bore / 2)
        .extrude(hub.length)
    )
    # The two bore edges are the circles that lie nearest to the axis.
    inner = cq.selectors.RadiusNthSelector(0)
    blank = blank.edges("%CIRCLE").edges(inner).chamfer(hub.chamfer)

    # What the cutter sweeps: its tip, with rounded corners, runs at the floor's height; its shank
    # reaches back to the bore axis, well inside the void, so that the cut is clean.
    # On this workplane local x is z of the part and the normal is +y.
    cutter = (
        cq.Workplane(cq.Plane(origin=(0, 0, hub.key_centre_z), xDir=(0, 0, 1), normal=(0, 1, 0)))
        .slot2D(hub.key_length, hub.key_width)
        .extrude(hub.floor_y)
        .faces(">Y")
        .edges()
        .fillet(hub.root_radius)
    )
    solid = blank.cut(cutter).val()
    if isinstance(solid, cq.Compound):
        (solid,) = solid.Solids()
    assert solid.isValid() and len(solid.Shells()) == 1
    return solid


def name_of(face, hub):
    """Which surface of the part this face belongs to."""
    kind = face.geomType()
    box = face.BoundingBox()
    middle_z = (box.zmin + box.zmax) / 2
    side = "near" if middle_z < hub.key_centre_z else "far"
    near = lambda a, b: abs(a - b) < 1e-4

    if kind == "CONE":
        return f"chamfer_{side}"
    if kind == "CYLINDER":
        cylinder = BRepAdaptor_Surface(face.wrapped).Cylinder()
        radius = cylinder.Radius()
        if near(radius, hub.root_radius):
            return "root"                                   # its straight runs
        along_bore = abs(cylinder.Axis().Direction().Z()) > 0.5
        if along_bore and near(radius, hub.bore / 2):
            return "bore"
        if along_bore and near(radius, hub.outside / 2):
            return "outside"
        if not along_bore and near(radius, hub.end_radius):
            return f"end_{side}"
    if kind == "TORUS":
        return "root"                                       # its turns at the round ends
    if kind == "PLANE":
        normal = face.normalAt()
        if near(abs(normal.z), 1):
            return f"face_{side}"
        if near(abs(normal.y), 1):
            return "floor"
        if near(abs(normal.x), 1):
            return "wall_neg" if face.Center().x < 0 else "wall_pos"
    raise ValueError(f"no name for a {kind} face at {face.Center().toTuple()}")


# The order of the groups in the file: the cavity first, then the rest.
GROUPS = [
    "floor", "root", "wall_neg", "wall_pos", "end_near", "end_far",
    "bore", "chamfer_near", "chamfer_far", "face_near", "face_far", "outside",
]


def triangulate(solid, hub):
    """Vertices (mm, rounded to 1e-6) and, per group, triangles wound with the normal out of the steel.

    The kernel divides every edge once, for both faces that meet there, so equal rounded
    coordinates are the same vertex and the mesh closes without gaps. (CadQuery's own
    Face.tessellate would mesh a face again, by itself, and tear its edges open.)
    """
    BRepMesh_IncrementalMesh(solid.wrapped, SAG, True, ANGLE, False)
    index, groups = {}, {name: [] for name in GROUPS}
    for face in solid.Faces():
        group, where = groups[name_of(face, hub)], TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face.wrapped, where)
        ids = []
        for i in range(1, mesh.NbNodes() + 1):
            p = mesh.Node(i).Transformed(where.Transformation())
            key = tuple(round(c, 6) + 0.0 for c in (p.X(), p.Y(), p.Z()))   # + 0.0 turns -0.0 into 0.0
            ids.append(index.setdefault(key, len(index)))
        # The kernel's triangles follow the surface; a reversed face looks the other way.
        order = (1, 3, 2) if face.wrapped.Orientation() == TopAbs_REVERSED else (1, 2, 3)
        for t in (mesh.Triangle(i) for i in range(1, mesh.NbTriangles() + 1)):
            group.append(tuple(ids[t.Value(k) - 1] for k in order))
    return list(index), groups


def check_closed(groups):
    """Each directed edge occurs once, and so does its reverse: closed and consistently wound."""
    edges = Counter(e for g in groups.values() for a, b, c in g for e in ((a, b), (b, c), (c, a)))
    assert all(n == 1 and edges[(b, a)] == 1 for (a, b), n in edges.items()), "the mesh is not closed"


def write_obj(path, hub, vertices, groups):
    number = lambda c: f"{c:.6f}".rstrip("0").rstrip(".")
    with open(path, "w", encoding="ascii", newline="\n") as out:
        count = sum(map(len, groups.values()))
        print("# Hub with a blind keyway in its bore; made by hub-blind-keyway.py (CadQuery)", file=out)
        print("# Units: mm. Bore axis z, keyway towards +y. Normals point out of the steel.", file=out)
        print(f"# bore {hub.bore:g}, key {hub.key_width:g} x {hub.key_length:g}, "
              f"floor at y = {hub.floor_y:g}, z {hub.key_start:g} to {hub.key_start + hub.key_length:g}, "
              f"root radius {hub.root_radius:g}", file=out)
        print(f"# {len(vertices)} vertices, {count} triangles", file=out)
        for v in vertices:
            print("v", *map(number, v), file=out)
        for name in GROUPS:
            print("g", name, file=out)
            for t in groups[name]:
                print("f", *(i + 1 for i in t), file=out)


def main():
    parser = argparse.ArgumentParser(description="Write the mesh of a hub with a blind keyway.")
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parent, help="directory")
    parser.add_argument("--step", action="store_true", help="write the exact solid as well")
    args = parser.parse_args()

    hub = Hub()
    solid = build(hub)
    vertices, groups = triangulate(solid, hub)
    check_closed(groups)
    path = args.out / "hub-blind-keyway.obj"
    write_obj(path, hub, vertices, groups)
    if args.step:
        cq.exporters.export(cq.Workplane(solid), str(path.with_suffix(".step")))

    print(f"{path}: {len(vertices)} vertices, {sum(map(len, groups.values()))} triangles, "
          f"CAD volume {solid.Volume():.4f} mm3")
    areas = Counter()
    for face in solid.Faces():
        areas[name_of(face, hub)] += face.Area()
    for name in GROUPS:
        print(f"  {name:13} {len(groups[name]):6} triangles   CAD area {areas[name]:10.4f} mm2")


if __name__ == "__main__":
    main()
