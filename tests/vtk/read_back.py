#!/usr/bin/python3
"""read_back.py GENU ROOT: runs two scenes, converts them and reads the .vtp files with VTK's own reader.

Held to results.csv and to plain geometry: ligaments' lengths from the points of their lines, forces and strains of every
row, contact points and forces on a tibia that rests, the femur's posed triangles beside the contact; for a layer the
sum of pressure times area over the triangles as VTK has them against the force of results.csv.
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

try:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    print("vtk_reader skipped: no python3-vtk9")
    sys.exit(77)

GENU, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])

SOFT_BALL = """format = 1
title = "ball on a layer"
units = { length = "mm", angle = "deg" }
[body.tibia]
fixed = true
[body.femur]
[joint.knee]
type = "free"
parent = "tibia"
child = "femur"
rotations = ["flexion x", "adduction y", "rotation z"]
translations = ["x", "y", "z"]
reference = { z = 19.5 }
[surface.ball]
body = "femur"
shape = %s
[surface.plate]
body = "tibia"
shape = "plane"
[contact.medial]
surfaces = ["plate", "ball"]
model = "cartilage"
modulus = 5
poisson = 0.4
thickness = 4
quadrature = "triangles"
cast_from = "ball"
[load.push]
body = "femur"
force = [0, 0, -30]
[[step]]
prescribe = { "knee.flexion" = [0, 10], "knee.adduction" = 0, "knee.rotation" = 0, "knee.x" = 0, "knee.y" = [0, 5] }
increments = 4
"""


def genu(*arguments):
    subprocess.run([GENU, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def near(found, expected, tolerance, what):
    if not abs(found - expected) <= tolerance:
        sys.exit(f"{what}: {found!r} is not {expected!r} to {tolerance}")


class Part:
    """A .vtp as VTK has read it."""

    def __init__(self, path):
        reader = vtkXMLPolyDataReader()
        if not reader.CanReadFile(str(path)):
            sys.exit(f"{path}: VTK cannot read it")
        reader.SetFileName(str(path))
        reader.Update()
        if reader.GetErrorCode() != 0:
            sys.exit(f"{path}: VTK's error {reader.GetErrorCode()}")
        self.data = reader.GetOutput()

    def point(self, i):
        return self.data.GetPoint(i)

    def cells(self):
        for c in range(self.data.GetNumberOfCells()):
            cell = self.data.GetCell(c)
            yield [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]

    @staticmethod
    def numbers(where, name):
        array = where.GetArray(name)
        return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]

    @staticmethod
    def words(where, name):
        array = where.GetAbstractArray(name)
        return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def series(folder):
    """Of each time, in order, its parts by name; every file of the list exists and is read once."""
    read, times = {}, {}
    for entry in ET.parse(folder / "poses.pvd").getroot().iter("DataSet"):
        file = folder / entry.get("file")
        read.setdefault(file, None)
        read[file] = read[file] or Part(file)
        times.setdefault(float(entry.get("timestep")), {})[entry.get("name")] = read[file]
    if {f for f in (folder / "vtp").iterdir()} != set(read):
        sys.exit(f"{folder}: files that the list does not name")
    return [times[t] for t in sorted(times)], sorted(times)


def rows_of(folder):
    with open(folder / "results.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_rigid_knee(work):
    genu("run", ROOT / "meshes/dortmans1984/scene.toml", "--no-report", "--quiet", "--out", work / "knee")
    genu("convert", work / "knee", "--to", "vtk", "--time", "knee.flexion_deg", "--out", work / "knee-vtk")
    rows = rows_of(work / "knee")
    poses, times = series(work / "knee-vtk")
    if len(poses) != len(rows) or len(rows) != 71:
        sys.exit(f"{len(poses)} times for {len(rows)} rows")
    for row, parts, time in zip(rows, poses, times):
        near(time, float(row["knee.flexion_deg"]), 0, "timestep")
        ligaments = parts["ligaments"]
        cell = ligaments.data.GetCellData()
        near(Part.numbers(ligaments.data.GetFieldData(), "TimeValue")[0][0], time, 0, "TimeValue")
        names = Part.words(cell, "name")
        if len(names) != 7:
            sys.exit(f"ligaments {names}")
        for k, path in enumerate(ligaments.cells()):
            length = sum(math.dist(ligaments.point(a), ligaments.point(b)) for a, b in zip(path, path[1:]))
            near(length, float(row[names[k] + ".length_mm"]), 1e-9, names[k] + " between its points")
            for array, column in (("force_N", ".force_N"), ("strain", ".strain")):
                near(Part.numbers(cell, array)[k][0], float(row[names[k] + column]), 0, names[k] + column)
        contacts = parts["contacts"]
        point = contacts.data.GetPointData()
        for k, name in enumerate(Part.words(point, "name")):
            x = contacts.point(k)
            for i, axis in enumerate("xyz"):
                near(x[i], float(row[f"{name}.tibia_{name}.{axis}_mm"]), 1e-9, f"{name} {axis}")
            near(Part.numbers(point, "force_N")[k][2], -float(row[f"{name}.force_N"]), 1e-9, f"{name} force")
            near(Part.numbers(point, "normal")[k][2], 1, 1e-12, f"{name} normal")
            condyle = parts[f"femur_{name}"]
            nearest = min(math.dist(x, condyle.point(i)) for i in range(condyle.data.GetNumberOfPoints()))
            near(nearest, 0, 2, f"the {name} condyle from its contact")  # mm: its triangles' edges are that long
            lowest = condyle.data.GetBounds()[4]
            near(lowest, 0, 0.3, f"the {name} condyle's lowest point")  # mm: what triangles leave of a round shape
        if Part.words(parts["femur_medial"].data.GetFieldData(), "body") != ["femur"]:
            sys.exit("the femur's surface does not name its body")


def check_layer(work):
    (work / "round.toml").write_text(SOFT_BALL % '"sphere"\nradius = 20')
    genu("mesh", work / "round.toml", "ball", "--edge", "1", "--out", work / "stl")
    (work / "soft.toml").write_text(SOFT_BALL % '"mesh"\nfile = "stl/ball.stl"\nunits = "mm"')
    genu("run", work / "soft.toml", "--no-report", "--quiet", "--out", work / "soft")
    genu("convert", work / "soft", "--to", "vtk", "--out", work / "soft-vtk")
    poses, _ = series(work / "soft-vtk")
    for row, parts in zip(rows_of(work / "soft"), poses):
        ball = parts["ball"]
        pressure = [p[0] for p in Part.numbers(ball.data.GetCellData(), "pressure_MPa")]
        near(max(pressure), float(row["medial.max_pressure_MPa"]), 1e-12, "largest pressure")
        if sum(p > 0 for p in pressure) != int(float(row["medial.points"])):
            sys.exit("triangles that carry pressure")
        force, area = [0.0] * 3, 0.0
        for p, (a, b, c) in zip(pressure, ball.cells()):
            if p <= 0:
                continue
            a, b, c = ball.point(a), ball.point(b), ball.point(c)
            u, v = [q - o for q, o in zip(b, a)], [q - o for q, o in zip(c, a)]
            twice = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            force = [f - p * t / 2 for f, t in zip(force, twice)]  # mm^2 MPa = N, against the outward normal
            area += math.hypot(*twice) / 2
        near(area, float(row["medial.area_mm2"]), 1e-6 * area, "area under pressure")
        near(math.hypot(*force), float(row["medial.force_N"]), 1e-6 * 30, "pressure times area")
        near(force[2], 30, 1e-6 * 30, "what holds the load")
        contact = parts["contacts"].data.GetPointData()
        for i in range(3):
            near(Part.numbers(contact, "force_N")[0][i], force[i], 1e-6 * 30, "resultant in the world")
        near(Part.numbers(contact, "max_pressure_MPa")[0][0], max(pressure), 1e-12, "largest pressure of the contact")


with tempfile.TemporaryDirectory() as name:
    check_rigid_knee(pathlib.Path(name))
    check_layer(pathlib.Path(name))
print("71 poses of a knee and 5 of a layer read by VTK: as results.csv has them")
