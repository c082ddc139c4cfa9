"""Compares `grainform measure` with trimesh, measure by measure, on closed and open meshes.

    python3 -m venv venv
    venv/bin/pip install trimesh numpy scipy
    cargo build --release
    venv/bin/python tests/trimesh/compare.py target/release/grainform

`cargo test` does not run it. Ends with 1 where a measure is off. Not compared are those that trimesh does not
have: outlines of bodies that are not convex, roundness of outlines, angularity and the spectrum.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import trimesh
from scipy.spatial import ConvexHull

ROUNDING = 1e-9
# The searches of grainform: for spheres, and for the least box, of which a round body has many local ones.
SEARCH = 1e-4
BOX = 2e-3


def askew(mesh):
    """The mesh turned and moved, with what trimesh made of its vertices forgotten."""
    turn = trimesh.transformations.euler_matrix(0.4, -1.1, 2.3)
    mesh = mesh.copy()
    mesh.apply_transform(turn)
    mesh.apply_translation([3.0, -20.0, 7.0])
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)


def joined(*meshes):
    return trimesh.util.concatenate(meshes)


def ellipsoid(axes, subdivisions=3):
    mesh = trimesh.creation.icosphere(subdivisions=subdivisions)
    mesh.apply_scale(axes)
    return mesh


def bean():
    """A bent ellipsoid: star-shaped, not convex."""
    mesh = ellipsoid([3.0, 1.0, 1.2])
    bent = mesh.vertices + np.outer(0.15 * mesh.vertices[:, 0] ** 2, [0.0, 1.0, 0.0])
    return trimesh.Trimesh(bent, mesh.faces, process=False)


def angle():
    """An L of constant thickness, from two prisms that share a face."""
    outline = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)]
    triangles = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    count = len(outline)
    vertices = [(x, y, z) for z in (0.0, 0.7) for x, y in outline]
    faces = [(c, b, a) for a, b, c in triangles]
    faces += [(a + count, b + count, c + count) for a, b, c in triangles]
    for i in range(count):
        j = (i + 1) % count
        faces += [(i, j, j + count), (i, j + count, i + count)]
    return trimesh.Trimesh(vertices, faces, process=False)


def without(mesh, faces):
    keep = np.ones(len(mesh.faces), dtype=bool)
    keep[faces] = False
    open_mesh = trimesh.Trimesh(mesh.vertices, mesh.faces[keep], process=False)
    open_mesh.remove_unreferenced_vertices()
    return open_mesh


def cases():
    """Name, mesh that grainform reads, mesh that trimesh measures (None where the inside is unknown)."""
    torus = trimesh.creation.torus(major_radius=3.0, minor_radius=0.8)
    inner = ellipsoid([1.0, 1.0, 0.5], 2)
    inner.invert()
    ball = ellipsoid([1.0, 1.0, 1.0])
    shapes = {
        "box": trimesh.creation.box([1.0, 2.0, 5.0]),
        "ellipsoid": ellipsoid([3.0, 2.0, 1.0]),
        "cylinder": trimesh.creation.cylinder(radius=1.0, height=3.0),
        "cone": trimesh.creation.cone(radius=1.0, height=2.0),
        "hull of points": trimesh.Trimesh(
            np.random.default_rng(7).normal(size=(60, 3)) * [3.0, 2.0, 1.0]
        ).convex_hull,
        "bean": bean(),
        "angle": angle(),
        "torus": torus,
        "two bodies": joined(ball, ellipsoid([0.5, 0.7, 0.9]).apply_translation([4.0, 1.0, 0.0])),
        "hollow": joined(ellipsoid([3.0, 2.0, 2.0]), inner),
    }
    for name, mesh in shapes.items():
        mesh = askew(mesh)
        yield name, mesh, mesh
    whole = askew(ellipsoid([3.0, 2.0, 1.0]))
    yield "open by one triangle", without(whole, [5]), whole
    high = whole.triangles_center @ [1.0, 0.0, 0.0]
    yield "open by half", without(whole, high > np.median(high)), None


def measure(program, mesh):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mesh.obj"
        # Text with all digits: other writers of trimesh round.
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.vertices.tolist()]
        lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.faces.tolist()]
        path.write_text("\n".join(lines) + "\n")
        command = [program, "measure", str(path), "--json"]
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def away(mesh, place):
    """Distance of a place from the surface."""
    triangles = mesh.triangles
    places = np.tile(place, (len(triangles), 1))
    nearest = trimesh.triangles.closest_point(triangles, places)
    return np.linalg.norm(nearest - places, axis=1).min()


def sums(mesh):
    """Keys of the report with what trimesh has, of one body or several."""
    moments = np.sort(mesh.principal_inertia_components)
    yield "area", mesh.area, ROUNDING
    yield "volume", mesh.volume, ROUNDING
    yield "centroid", mesh.center_mass, ROUNDING
    yield "inertia", mesh.moment_inertia, ROUNDING
    yield "principal.moments", moments, ROUNDING
    yield "faces.bodies", sum(part.volume > 0 for part in mesh.split(only_watertight=False)), 0


def form(mesh, report):
    """The same of what only one body has."""
    hull = mesh.convex_hull
    axes = np.array(report["principal"]["axes"])
    dimensions = -np.sort(-np.ptp(mesh.vertices @ axes.T, axis=0))
    long, middle, short = dimensions
    enclosing = report["spheres"]["enclosing"]["radius"]
    wadell = (36 * np.pi * mesh.volume**2) ** (1 / 3) / mesh.area
    i1, i2, i3 = np.sort(mesh.principal_inertia_components)
    squares = np.array([i2 + i3 - i1, i1 + i3 - i2, i1 + i2 - i3]) / 2
    for name, value in zip(["length", "width", "thickness"], dimensions):
        yield f"dimensions.{name}", value, ROUNDING
    yield "form.aspect_ratio", long / short, ROUNDING
    yield "form.elongation", middle / long, ROUNDING
    yield "form.flatness", short / middle, ROUNDING
    yield "sphericity.wadell", wadell, ROUNDING
    yield "sphericity.operational", (3 * mesh.volume / (4 * np.pi)) ** (1 / 3) / enclosing, ROUNDING
    yield "sphericity.krumbein", (middle * short / long**2) ** (1 / 3), ROUNDING
    yield "sphericity.maximum_projection", (short**2 / (long * middle)) ** (1 / 3), ROUNDING
    yield "convexity.volume", mesh.volume / hull.volume, ROUNDING
    yield "convexity.area", hull.area / mesh.area, ROUNDING
    yield "ellipsoid.semi_axes", np.sqrt(5 * squares / mesh.volume), ROUNDING
    if report["spheres"]["inscribed"]:
        yield "spheres.inscribed.radius", away(mesh, report["spheres"]["inscribed"]["centre"]), SEARCH
    sides = [report["minimum_box"][name] for name in ("thickness", "width", "length")]
    yield "ratios.short_to_long", sides[0] / sides[2], ROUNDING
    yield "ratios.intermediate_to_long", sides[1] / sides[2], ROUNDING
    yield "ratios.short_to_intermediate", sides[0] / sides[1], ROUNDING


def outlines(mesh, report):
    """Outlines of a convex body."""
    axes = np.array(report["principal"]["axes"])
    for i, axis in enumerate(axes):
        across = np.delete(axes, i, axis=0)
        outline = ConvexHull(mesh.vertices @ across.T)
        yield f"projections.{i}.area", outline.volume, SEARCH
        yield f"projections.{i}.perimeter", outline.area, SEARCH
        shadow = np.abs(mesh.face_normals @ axis) @ mesh.area_faces / 2
        yield f"projections.{i}.area", shadow, SEARCH


def at(report, key):
    for part in key.split("."):
        report = report[int(part)] if isinstance(report, list) else report[part]
    return report


class Judge:
    def __init__(self, name):
        self.name, self.compared, self.wrong = name, 0, []

    def compare(self, expected):
        for key, value, error in expected:
            value, found = np.array(value, dtype=float), np.array(at(self.report, key), dtype=float)
            off = np.max(np.abs(found - value)) / max(np.max(np.abs(value)), 1e-300)
            self.check(off <= error, f"{key}: {found.tolist()}, trimesh {value.tolist()}")

    def check(self, is_right, sentence):
        self.compared += 1
        if not is_right:
            self.wrong.append(f"{self.name}: {sentence}")

    def judge(self, program, mesh, solid):
        self.report = report = measure(program, mesh)
        self.around(mesh)
        if solid is None:
            for key in ("area", "volume", "centroid", "dimensions", "form"):
                self.check(report[key] is None, f"{key} of an open mesh is told")
            return
        self.compare(sums(solid))
        if report["faces"]["bodies"] > 1:
            for key in ("dimensions", "form", "sphericity", "convexity"):
                self.check(report[key] is None, f"{key} of several bodies is told")
            return
        self.compare(form(solid, report))
        if solid.is_convex:
            self.compare(outlines(solid, report))


    def around(self, mesh):
        """Box and sphere hold the body and are no larger than those of trimesh, which need not be the least."""
        found = self.report["minimum_box"]
        sides = np.array([found[name] for name in ("length", "width", "thickness")])
        beyond = np.abs((mesh.vertices - found["centre"]) @ np.array(found["axes"]).T) - sides / 2
        self.check(np.max(beyond) <= ROUNDING * sides[0], f"minimum_box: a vertex is {np.max(beyond)} outside")
        self.check(abs(np.prod(sides) / found["volume"] - 1) <= ROUNDING, "minimum_box.volume: not of its sides")
        other = np.prod(mesh.bounding_box_oriented.primitive.extents)
        self.check(
            found["volume"] <= other * (1 + BOX), f"minimum_box.volume: {found['volume']}, trimesh {other}"
        )
        found = self.report["spheres"]["enclosing"]
        radius = found["radius"]
        farthest = np.linalg.norm(mesh.vertices - found["centre"], axis=1).max()
        self.check(abs(farthest / radius - 1) <= ROUNDING, f"spheres.enclosing: {radius}, farthest {farthest}")
        other = trimesh.nsphere.minimum_nsphere(mesh)[1]
        self.check(radius <= other * (1 + SEARCH), f"spheres.enclosing.radius: {radius}, trimesh {other}")


def main(program):
    wrong = []
    for name, mesh, solid in cases():
        judge = Judge(name)
        judge.judge(program, mesh, solid)
        print(f"{name}: {judge.compared} compared, {len(judge.wrong)} off")
        wrong += judge.wrong
    for sentence in wrong:
        print(sentence)
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
