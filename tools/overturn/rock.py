"""Makes a table of blocks from a mesh of a rock or a statue and its points of contact: for each vertical plane through
the centre of mass, the angles and distances of the two pivots and the radius of gyration."""

from __future__ import annotations

import collections
import csv
import dataclasses
import io
import math
import os
import pathlib
import re
import sys

import meshio
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull

from overturn.output_file import PICTURES, save, write_text
from overturn.synthetic_record import natural, positive
from overturn.tool import USAGE, ToolError, parse_with_output, parser_of

__all__ = ["Rock", "mass_properties", "measure", "read_contacts", "read_mesh"]

EXAMPLE = """\
example:
  tools/rock jobs/rock.obj --contacts jobs/rock_contacts.csv --picture rock.png   # writes rock_blocks.csv
  overturn assess rock_blocks.csv --period 0.5 --pga 0.4

The contacts are a table with the columns x, y, z, in the coordinates and the unit of the mesh. The
table of blocks has a row for each edge of their outline in plan, in the plane across the edge, or
with --step for each of these azimuths. The side plus is that to which the azimuth points. The pivots
are where the vertical plane through the centre of mass cuts the outline. The column azimuth_of says
that the rows are one rock, which falls if it falls in one of them.

Azimuths are counted from x towards y, to the left seen from above. With --x-azimuth, the table also
has the column direction, on a compass: it is then for records with a component to the north
(scene.record) and one to the east (scene.second_component). Without it, it is for one component or a
pulse.

Refused are meshes that are open, of several bodies or with some faces turned, and rocks that would
fall without shaking. A mesh that is turned inside out is turned back."""

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001}
PLAN = {"z": (1, 2, 3), "-z": (1, -2, -3), "y": (1, -3, 2), "-y": (1, 3, -2), "x": (2, 3, 1), "-x": (2, -3, -1)}  # axes in plan, up
SUFFIXES = (".obj", ".ply", ".stl")
COARSEST = 1e-3  # step of single precision over the least extent of the mesh [1]
FLAT = 0.01  # deviation of a hole from a plane over its width, to be filled [1]
MARGIN = 0.02  # by which contacts may lie outside the mesh, over the diagonal of its box [1]
FAR = 0.03  # distance of a contact from the surface, over the diagonal, that is reported [1]
LINE = 1e-6  # width of the contacts over their length, below which they are on one line [1]
DENSE = 12  # corners of an outline from which on its points are not moved one by one
SMALLEST, LARGEST = 0.05, 50.0  # usual sizes of a rock [m]


@dataclasses.dataclass(frozen=True)
class Rock:
    """A rock on its contacts. Lengths are in metres; z is up, x and y are those of the mesh turned by `up`."""

    name: str  # in the column `azimuth_of` of its table
    volume: float  # [m3]
    centre: np.ndarray  # of mass, in the coordinates and the unit of the mesh
    inertia: np.ndarray  # of each unit of mass, about the centre of mass [m2]
    contacts: np.ndarray  # from the centre of mass
    hull: np.ndarray  # the contacts on the outline in plan, counter-clockwise
    outline: np.ndarray  # of the whole mesh in plan
    gap: float  # largest distance of a contact from the surface of the mesh
    faces: int
    notes: tuple[str, ...]

    def section(self, azimuth):
        """Returns the pivots on the side to which the azimuths [rad] point: their horizontal distances and heights from
        the centre of mass. s e = A + t (B - A) on the edge from A to B, with e = (cos, sin) of the azimuth."""
        along = np.stack([np.cos(azimuth), np.sin(azimuth)], -1)[:, None]
        edge = self._hull_edges()
        outward = _cross(along, edge)
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = np.where(outward > 0, _cross(self.hull, edge) / outward, np.inf)
        found = distance.argmin(axis=1)
        rows = np.arange(len(found))
        place = np.clip(_cross(self.hull, along)[rows, found] / outward[rows, found], 0, 1)
        return distance[rows, found], self.hull[found, 2] + place * edge[found, 2]

    def slenderness(self, azimuth):
        """Returns alpha on the side to which the azimuths [rad] point [rad]."""
        distance, height = self.section(azimuth)
        return np.arctan2(distance, -height)

    def edges(self):
        """Returns the azimuths of the outward normals of the edges of the hull [rad]."""
        edge = self._hull_edges()
        return np.arctan2(-edge[:, 0], edge[:, 1])

    def weakest(self):
        """Returns the least alpha and its azimuth [rad]. On the edge A + t d, tan^2 alpha = |A + t d|^2 / (A_z + t d_z)^2
        (its numerator in plan) is least at an end or at t = (|A|^2 d_z - (A.d) A_z) / (|d|^2 A_z - (A.d) d_z)."""
        start, edge = self.hull, self._hull_edges()
        product, size, length = ((a * b)[:, :2].sum(axis=1) for a, b in ((start, edge), (start, start), (edge, edge)))
        place = (size * edge[:, 2] - product * start[:, 2]) / (length * start[:, 2] - product * edge[:, 2])
        pivot = np.concatenate([start, start + np.clip(place, 0, 1)[:, None] * edge])
        slenderness = np.arctan2(np.hypot(pivot[:, 0], pivot[:, 1]), -pivot[:, 2])
        least = slenderness.argmin()
        return slenderness[least], math.atan2(pivot[least, 1], pivot[least, 0])

    def table(self, step: float | None = None, x_azimuth: float | None = None, names: str = "") -> dict:
        """Returns the columns of a table of blocks: a row for each edge of the outline or, with `step` [degree], for each
        azimuth. They are one `azimuth_of`, which falls if it falls in one of them. x_azimuth: of x on a compass [degree];
        gives the column direction. names: before the names of the rows."""
        if step is None:
            azimuth = self.edges()
            name = [f"{names}edge {i + 1}" for i in range(len(azimuth))]
            compass = ((x_azimuth or 0) - np.degrees(azimuth)) % 360
        else:
            if not (0 < step <= 180 and abs(360 / step - round(360 / step)) < 1e-9):
                raise ToolError(f"a step of {step:g} degrees does not divide the circle. Give one that does, such as 15.",
                                USAGE)
            compass = step * np.arange(round(360 / step))  # without one, from x
            azimuth = np.radians(compass if x_azimuth is None else x_azimuth - compass)
            name = [f"{names}{degrees:g} degrees" for degrees in compass]
        sides = [self.section(azimuth), self.section(azimuth + np.pi)]
        across = np.stack([-np.sin(azimuth), np.cos(azimuth), 0 * azimuth], -1)
        spun = across @ self.inertia
        gyration2 = (spun * across).sum(axis=1)
        columns = {"azimuth_of": [self.name] * len(name), "name": name, "azimuth_from_x": np.degrees(azimuth) % 360}
        if x_azimuth is not None:
            columns["direction"] = np.where(compass % 360 < 360, compass % 360, 0)  # of -1e-15, % is 360
        for side, (distance, height) in zip(("plus", "minus"), sides):
            columns[f"slenderness_{side}"] = np.arctan2(distance, -height)
        for side, (distance, height) in zip(("plus", "minus"), sides):
            columns[f"size_{side}"] = np.hypot(distance, height)
        return {**columns, "radius_of_gyration": np.sqrt(gyration2),
                "coupling": np.linalg.norm(spun - gyration2[:, None] * across, axis=1) / gyration2}

    def jittered(self, deviation, samples, seed=1):
        """Yields the rock on contacts that are moved at random by the standard deviation [m] in each coordinate, one by
        one, or as a whole if the outline is dense: moved one by one, its outermost points would widen it. Yields None
        where the centre of mass is then outside."""
        generator = np.random.default_rng(seed)
        for _ in range(samples):
            moved = self.contacts + generator.normal(0, deviation, (1 if self.is_dense() else len(self.contacts), 3))
            try:
                yield dataclasses.replace(self, contacts=moved, hull=_hull_of(moved))
            except ToolError:
                yield None

    def is_dense(self):
        return len(self.hull) > DENSE

    def _hull_edges(self):
        return np.roll(self.hull, -1, axis=0) - self.hull


def _cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def measure(mesh: str | os.PathLike, contacts: str | os.PathLike, unit: str = "m", up: str = "z", fill: bool = False,
            name: str | None = None) -> Rock:
    """Returns the Rock of a mesh (.obj, .ply, .stl) on the contacts of a table. Its name is that of the mesh, without
    the extension, if none is given. Raises ToolError for those that have no answer."""
    name = (pathlib.Path(mesh).stem if name is None else name).strip()
    if not name:
        raise ToolError("the name of a rock must not be empty.", USAGE)
    points, faces = read_mesh(mesh)
    supports = read_contacts(contacts)
    origin = (points.min(axis=0) + points.max(axis=0)) / 2
    diagonal = np.linalg.norm(np.ptp(points, axis=0))
    outside = np.abs(supports - origin) > np.ptp(points, axis=0) / 2 + MARGIN * diagonal
    if outside.any():
        where = outside.any(axis=1).argmax()
        raise ToolError(f"contact {where + 1} of \"{contacts}\", {_place(supports[where])}, lies outside the mesh, which is "
                        f"from {_place(points.min(axis=0))} to {_place(points.max(axis=0))}. Give the contacts in the "
                        "coordinates and the unit of the mesh.")
    axes = UNITS[unit] * np.array([np.sign(axis) * np.eye(3)[abs(axis) - 1] for axis in PLAN[up]])
    faces, notes = _closed(points, faces, mesh, fill, UNITS[unit])
    corners = ((points - origin) @ axes.T)[faces]
    volume, centre, inertia = mass_properties(corners)
    if abs(volume) < 1e-9 * (UNITS[unit] * diagonal) ** 3:
        raise ToolError(f"\"{mesh}\" has no volume. Give a mesh of the whole surface.")
    if volume < 0:
        notes.append("the mesh was turned inside out; its faces are turned back")
    if not SMALLEST < UNITS[unit] * diagonal < LARGEST:
        notes.append(f"the diagonal of the mesh is {UNITS[unit] * diagonal:.4g} m. Is its unit {unit} (--unit)?")
    gaps = [_distance((support - origin) @ axes.T, corners) for support in supports]
    farthest = int(np.argmax(gaps))
    if gaps[farthest] > FAR * UNITS[unit] * diagonal:
        notes.append(f"contact {farthest + 1} is {gaps[farthest]:.3g} m from the surface of the mesh. Where does the rock touch "
                     "its pedestal?")
    supports = (supports - origin) @ axes.T - centre
    outline = (points - origin) @ axes.T - centre
    return Rock(name=name, volume=abs(volume), centre=origin + np.linalg.solve(axes, centre), inertia=inertia,
                contacts=supports, hull=_hull_of(supports), outline=outline[ConvexHull(outline[:, :2]).vertices],
                gap=gaps[farthest], faces=len(faces), notes=tuple(notes))


def _distance(point, corners):
    """Returns the distance of a point from the triangles (n, 3, 3)."""
    start = corners - point
    edge = np.roll(start, -1, axis=1) - start
    length2 = np.maximum((edge**2).sum(axis=2), np.finfo(float).tiny)
    place = np.clip(-(start * edge).sum(axis=2) / length2, 0, 1)
    from_edges = np.linalg.norm(start + place[..., None] * edge, axis=2).min(axis=1)
    normal = np.cross(edge[:, 0], edge[:, 1])
    size = np.maximum(np.linalg.norm(normal, axis=1), np.finfo(float).tiny)
    above = (np.einsum("fki,fi->fk", np.cross(start, edge), normal) >= 0).all(axis=1)  # its foot is within the triangle
    from_plane = np.abs((start[:, 0] * normal).sum(axis=1)) / size
    return float(np.where(above, from_plane, from_edges).min())


def mass_properties(corners):
    """Returns the volume, the centre of mass, and the inertia of each unit of mass about it, of a closed surface of
    triangles (n, 3, 3), whose coordinates should be small. With det = a.(b x c) and s = a + b + c of each,

        V = sum det / 6,   G = sum det s / (24 V),   C = sum det (s s' + a a' + b b' + c c') / (120 V) - G G',
        J/m = tr C 1 - C

    V is negative if the faces are turned inside out."""
    det = np.einsum("fi,fi->f", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    volume = det.sum() / 6
    if volume == 0:
        return 0.0, np.zeros(3), np.zeros((3, 3))
    total = corners.sum(axis=1)
    centre = det @ total / (24 * volume)
    second = np.einsum("f,fi,fj->ij", det, total, total) + np.einsum("f,fki,fkj->ij", det, corners, corners)
    covariance = second / (120 * volume) - np.outer(centre, centre)
    return volume, centre, np.trace(covariance) * np.eye(3) - covariance


def read_mesh(path):
    """Returns the points (n, 3) and the triangles (m, 3) of a file; equal points are one."""
    suffix = pathlib.Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise ToolError(f"\"{path}\" must end in .obj, .ply or .stl.", USAGE)
    try:
        if suffix == ".stl":
            return _expect_sound(*_read_stl(path), path)
        if suffix == ".ply":
            _expect_plain_ply(path)
        mesh = meshio.ply.read(path) if suffix == ".ply" else meshio.obj.read(path)
    except OSError as error:
        raise ToolError(f"cannot read \"{path}\": {error.strerror or error}.") from error
    except ToolError:
        raise
    except Exception as error:  # of any kind: meshio does not check what it parses
        raise ToolError(f"cannot read \"{path}\": it is damaged, or meshio does not read it ({type(error).__name__}: {error}). "
                        "Save it again, or in another of the formats .obj, .ply, .stl.") from error
    corners = [np.asarray(block.data) for block in mesh.cells if np.ndim(block.data) == 2 and np.shape(block.data)[1] > 2]
    return _expect_sound(mesh.points, [_fan(each.astype(np.int64)) for each in corners], path)


def _read_stl(path):
    """Returns the points and the triangles of a binary file, which is as long as its count says, or of a text. (meshio
    takes a file that is cut off for an empty one, and fails on a text with an empty line.)"""
    data = pathlib.Path(path).read_bytes()
    if len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        points = np.frombuffer(data, "V12, (9,)<f4, V2", offset=84)["f1"].reshape(-1, 3)
    else:
        points = np.array(re.findall(rb"(?i)\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", data), float).reshape(-1, 3)
        if len(points) % 3 or not re.search(rb"(?i)endsolid[^\n]*\s*$", data):
            raise ToolError(f"\"{path}\" is cut off, or no STL file. Save it again.")
    return points, [np.arange(len(points)).reshape(-1, 3)]


def _expect_plain_ply(path):
    """Refuses what meshio reads as other numbers: properties of faces besides their corners, and coordinates that are
    not the first properties of points; and files that are cut off, in which it may read on for ever."""
    data = pathlib.Path(path).read_bytes()
    end = re.search(rb"\nend_header\s*\n", data)
    header = data[:end.start() if end else 0].decode("latin-1")
    counts = [int(count) for count in re.findall(r"\nelement \w+ (\d+)", header)]
    if not counts or max(counts) > len(data):
        raise ToolError(f"\"{path}\" is cut off, or no PLY file. Save it again.")
    properties = {element.split()[0]: [line.split() for line in element.splitlines()[1:] if line.startswith("property")]
                  for element in header.split("\nelement ")[1:]}
    others = [each[-1] for each in properties.get("face", ()) if each[-1] != "vertex_indices"]
    if others:
        raise ToolError(f"the faces of \"{path}\" have the property {others[0]}. Save them with vertex_indices only, "
                        "without colours and textures, or as .obj or .stl.")
    if [each[-1] for each in properties.get("vertex", ())][:3] != ["x", "y", "z"]:
        raise ToolError(f"the points of \"{path}\" do not begin with x, y, z. Save it again, or as .obj or .stl.")


def _expect_sound(points, faces, path):
    """Returns the points, equal ones as one, and the triangles without those that have no area."""
    if not sum(map(len, faces)):
        raise ToolError(f"\"{path}\" has no faces: it is a cloud of points, or cut off. Give a mesh.")
    faces = np.concatenate(faces)
    if np.ndim(points) != 2 or points.shape[1] < 3:
        raise ToolError(f"the points of \"{path}\" do not have three coordinates. Save it again.")
    if faces.min() < 0:
        raise ToolError(f"\"{path}\" has a face with a corner that is counted from the end, such as f -3 -2 -1. Save it "
                        "with positive numbers, or as .ply.")
    if faces.max() >= len(points):
        raise ToolError(f"\"{path}\" has a face with corner {faces.max() + 1}, but {len(points)} points. Save it again.")
    if not np.isfinite(points).all():
        raise ToolError(f"\"{path}\" has a point that is not a number. Save it again.")
    extent = np.ptp(points[:, :3], axis=0).min()
    if points.dtype == np.float32 and (step := np.spacing(np.abs(points[:, :3]).max())) > COARSEST * extent:
        raise ToolError(f"the coordinates of \"{path}\" are in steps of {step:.3g}, because they are large and in single "
                        f"precision; the mesh is {extent:.3g} wide. Save it with an origin close to it, or in double "
                        "precision.")
    points, number = np.unique(points[:, :3].astype(float) + 0.0, axis=0, return_inverse=True)  # + 0.0: no -0
    faces = number.reshape(-1)[faces]
    return points, faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]


def _fan(polygons):
    """Returns the triangles of polygons of equally many corners."""
    first = np.repeat(polygons[:, :1], polygons.shape[1] - 2, axis=1)
    return np.stack([first, polygons[:, 1:-1], polygons[:, 2:]], axis=-1).reshape(-1, 3)


def _closed(points, faces, path, fill, unit):
    """Returns the faces of a closed surface of one body, and what was done. Every edge is that of two faces, which run
    along it in opposite ways."""
    notes = []
    first, second, number, count = _edges(faces, len(points))
    balance = np.bincount(number, np.where(first < second, 1, -1))
    for wrong, what in ((count > 2, "are those of more than two faces: it touches itself or has faces twice. Repair it, "
                                    "for example with MeshLab"),
                        ((count == 2) & (balance != 0), "are those of two faces that are turned differently, one inside "
                                                        "out. Orient its faces coherently, for example with MeshLab")):
        if wrong.any():
            place = points[first[wrong[number].argmax()]]
            raise ToolError(f"{wrong.sum()} edges of \"{path}\" {what}. One is near {_place(place)}.")
    free = count[number] == 1
    for hole in _loops(zip(first[free].tolist(), second[free].tolist())):
        rim = points[hole] - points[hole].mean(axis=0)
        width = np.linalg.norm(np.ptp(rim, axis=0))
        depth = np.abs(rim @ np.linalg.svd(rim, full_matrices=False)[2][-1]).max()
        found = f"a hole of {len(hole)} edges, {unit * width:.3g} m wide, at {_place(points[hole].mean(axis=0))}"
        if not fill or depth > FLAT * width:
            raise ToolError(f"\"{path}\" is open: it has {found}, whose rim departs by {unit * depth:.2g} m from a plane. " + (
                "Model the missing surface: --fill closes flat holes only." if depth > FLAT * width else
                "Close it with --fill if the missing surface is flat there, or model it."))
        faces = np.concatenate([faces, _fan(np.array([hole[::-1]]))])
        notes.append(f"{found}, is closed by a flat surface")
    if not len(faces):
        raise ToolError(f"no face of \"{path}\" has an area. Give a mesh of the surface.")
    _expect_one_body(points, faces, path, unit)
    return faces, notes


def _edges(faces, points):
    """Returns, of the three edges of every face, the ends in its order and the number of the edge; and how many faces
    each of these edges has."""
    first, second = faces.T.ravel(), np.roll(faces, -1, axis=1).T.ravel()
    key = np.minimum(first, second) * points + np.maximum(first, second)
    _, number, count = np.unique(key, return_inverse=True, return_counts=True)
    return first, second, number.reshape(-1), count


def _loops(edges):
    """Returns the closed chains of directed edges, of which as many lead to a point as from it."""
    following = collections.defaultdict(list)
    for start, end in edges:
        following[start].append(end)
    loops = []
    for start, ends in following.items():
        while ends:
            loop = [start]
            while (end := following[loop[-1]].pop()) != start:
                loop.append(end)
            loops.append(loop)
    return loops


def _expect_one_body(points, faces, path, unit):
    *_, number, _ = _edges(faces, len(points))
    order = np.argsort(number, kind="stable")
    same = np.flatnonzero(number[order][1:] == number[order][:-1])
    pairs = order[same] % len(faces), order[same + 1] % len(faces)
    bodies, body = connected_components(coo_matrix((np.ones(len(same)), pairs), shape=(len(faces),) * 2), directed=False)
    if bodies > 1:
        shifted = points - points.mean(axis=0)
        volumes = [unit**3 * mass_properties(shifted[faces[body == i]])[0] for i in range(min(bodies, 1000))]
        largest = ", ".join(f"{volume:.3g}" for volume in sorted(volumes, key=abs)[:-6:-1])
        raise ToolError(f"\"{path}\" has {bodies} bodies, of the volumes {largest}{' ...' * (bodies > 5)} m3; a negative one "
                        "is a cavity or turned inside out. Keep one, without fragments, or join them.")


def read_contacts(path):
    """Returns the columns x, y, z of a table, whose values are separated by commas, semicolons or tabs."""
    try:
        lines = pathlib.Path(path).read_text(encoding="utf-8-sig").splitlines()
    except OSError as error:
        raise ToolError(f"cannot read \"{path}\": {error.strerror}.") from error
    except UnicodeDecodeError as error:
        raise ToolError(f"\"{path}\" is not a text in UTF-8. Save it as CSV.") from error
    head = lines[0] if lines else ""
    separator = next((each for each in ";\t" if each in head), ",")
    names = [name.strip(' "') for name in head.split(separator)]
    if missing := [name for name in "xyz" if names.count(name) != 1]:
        raise ToolError(f"{path}:1: the first line must name the columns x, y, z, each once, but does not do so for "
                        f"{missing[0]}.")
    rows = []
    for number, row in enumerate(csv.reader(lines[1:], delimiter=separator), 2):
        if not any(word.strip() for word in row):
            continue
        try:
            words = [row[names.index(name)] for name in "xyz"]
            rows.append([float(word if separator == "," else word.replace(",", ".")) for word in words])
            if not np.isfinite(rows[-1]).all():
                raise ValueError
        except (ValueError, IndexError):
            raise ToolError(f"{path}:{number}: \"{separator.join(row)}\" does not have the three numbers x, y, z.") from None
    return np.array(rows).reshape(-1, 3)


def _hull_of(contacts):
    """Returns the contacts on the outline in plan, counter-clockwise; the centre of mass, the origin, is within it."""
    if len(contacts) < 3:
        raise ToolError(f"{len(contacts)} contacts do not support a rock. Give three or more that are not on one line.")
    plan = contacts[:, :2]
    length, width = np.linalg.svd(plan - plan.mean(axis=0), compute_uv=False)
    if width <= LINE * length:
        raise ToolError("the contacts are on one line. Give three or more that are not.")
    hull = contacts[ConvexHull(plan).vertices]
    edge = np.roll(hull, -1, axis=0) - hull
    distance = _cross(hull, edge) / np.hypot(edge[:, 0], edge[:, 1])
    if distance.min() <= 0:
        raise ToolError(f"the centre of mass is {-distance.min():.3g} m outside the outline of the contacts: the rock falls "
                        "without shaking. Check the contacts, --up and whether the mesh is complete.")
    if hull[:, 2].max() >= 0:
        raise ToolError(f"a contact is {hull[:, 2].max():.3g} m above the centre of mass. Check the contacts and --up.")
    return hull


def _place(point):
    return "(" + ", ".join(f"{value:.10g}" for value in point) + ")"


def text_of(columns):
    """Returns a table as CSV, with numbers that are read back exactly."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(map(str, row) for row in (columns, *zip(*columns.values())))
    return text.getvalue()


def towards(azimuth, x_azimuth):
    """Returns an azimuth [rad] in words: on a compass, if that of x [degree] is known."""
    degrees = math.degrees(azimuth) if x_azimuth is None else x_azimuth - math.degrees(azimuth)
    return f"{degrees % 360:.1f} degrees" + " from x" * (x_azimuth is None)


def summary(rock, columns, arguments):
    """Yields the lines that are printed."""
    yield f"mesh        {rock.faces} faces, closed; volume {rock.volume:.5g} m3" + (
        f", mass {arguments.density * rock.volume:.5g} kg" if arguments.density else "")
    yield f"centre      {_place(rock.centre)} in the mesh"
    yield f"contacts    {len(rock.contacts)}, {len(rock.hull)} on their outline; up to {rock.gap:.2g} m from the surface"
    least, azimuth = rock.weakest()
    yield f"weakest     alpha = {math.degrees(least):.4g} degrees towards {towards(azimuth, arguments.x_azimuth)}"
    yield ""
    yield f"{'plane':13} azimuth  alpha+  alpha-      R+      R-       k coupling"
    keys = ("slenderness_plus", "slenderness_minus", "size_plus", "size_minus", "radius_of_gyration")
    angle = columns.get("direction", columns["azimuth_from_x"])
    for name, *values, coupling in zip(columns["name"], angle, *np.degrees([columns[key] for key in keys[:2]]),
                                       *(columns[key] for key in keys[2:]), columns["coupling"]):
        yield f"{name:13}" + " {:7.1f} {:7.2f} {:7.2f} {:7.3f} {:7.3f} {:7.3f}".format(*values) + f" {coupling:8.3f}"
    weakest = np.minimum(columns["slenderness_plus"], columns["slenderness_minus"]).argmin()
    yield f"\nazimuth, alpha in degrees; R, k in m. For {columns['name'][weakest]}:"
    yield "  overturn topple " + " ".join(f"--{key.replace('_', '-')} {columns[key][weakest]:.6g}" for key in keys) + \
        " --period 0.5"


def sampled(rock, columns, arguments):
    """Returns the table with the rows of all samples, and what to print of them."""
    tables = [{**columns, "sample": [0] * len(columns["name"])}]
    least = []
    for number, sample in enumerate(rock.jittered(arguments.jitter, arguments.samples, arguments.seed), 1):
        if sample:
            least.append(math.degrees(sample.weakest()[0]))
            rows = sample.table(arguments.step, arguments.x_azimuth, f"sample {number}: ")
            tables.append({**rows, "sample": [number] * len(rows["name"])})
    columns = {key: [value for table in tables for value in table[key]] for key in tables[0]}
    text = f"samples     {arguments.samples}, contacts moved by {arguments.jitter:g} m " + (
        "as a whole: their outline is dense" if rock.is_dense() else "each")
    if least:
        text += "; least alpha " + ", ".join(f"{value:.4g}" for value in np.quantile(least, [0.05, 0.5, 0.95])) + \
            " degrees (5, 50, 95 %)"
    if falling := arguments.samples - len(least):
        text += f"\n            {falling} would fall without shaking and have no rows"
    return columns, text


def read_arguments(argv):
    parser = parser_of("rock", __doc__, EXAMPLE)
    parser.add_argument("file", metavar="MESH", help="closed surface: .obj, .ply or .stl")
    parser.add_argument("--contacts", metavar="FILE.csv", required=True, help="points of contact: columns x, y, z")
    parser.add_argument("--unit", choices=UNITS, default="m", help="of mesh and contacts (default: %(default)s)")
    parser.add_argument("--up", choices=PLAN, default="z", help="the axis that points up (default: %(default)s); a negative "
                        "one as in --up=-y")
    parser.add_argument("--x-azimuth", metavar="DEG", type=float, help="azimuth of the axis x on a compass (of y with --up "
                        "x or -x), clockwise from north; adds the column direction")
    parser.add_argument("--name", help="of the rock, in the column azimuth_of (default: that of the mesh)")
    parser.add_argument("--density", metavar="RHO", type=positive, help="[kg/m3], to print the mass")
    parser.add_argument("--step", metavar="DEG", type=positive, help="rows at this step of azimuth, not for each edge")
    parser.add_argument("--fill", action="store_true", help="close flat holes")
    parser.add_argument("--jitter", metavar="M", type=positive, help="also rows of samples whose contacts are moved at "
                        "random, with this standard deviation in each coordinate [m]")
    parser.add_argument("--samples", metavar="N", type=natural, default=100, help="their number (default: %(default)s)")
    parser.add_argument("--seed", metavar="S", type=natural, default=1, help="of the random numbers (default: %(default)s)")
    parser.add_argument("--picture", metavar="OUT.png", help="draw plan and alpha: .png, .pdf or .svg")
    arguments = parse_with_output(parser, argv, "FILE_blocks.csv", "table of blocks")
    if arguments.x_azimuth is not None and not math.isfinite(arguments.x_azimuth):
        parser.error("--x-azimuth must be finite")
    if arguments.picture and pathlib.Path(arguments.picture).suffix not in PICTURES:
        parser.error(f"\"{arguments.picture}\" must end in .png, .pdf or .svg")
    return arguments


def main(argv=None):
    arguments = read_arguments(argv)
    found = measure(arguments.file, arguments.contacts, arguments.unit, arguments.up, arguments.fill, arguments.name)
    for note in found.notes:
        print(f"rock: {note}", file=sys.stderr)
    columns = found.table(arguments.step, arguments.x_azimuth)
    print(*summary(found, columns, arguments), sep="\n")
    if arguments.jitter:
        columns, text = sampled(found, columns, arguments)
        print(text)
    write_text(arguments.output, text_of(columns), "a table of tools/rock",
               lambda beginning: beginning.startswith(b"azimuth_of,name,azimuth_from_x,"))
    print(arguments.output)
    if arguments.picture:
        from overturn.plot.rocks import rock as draw
        save(draw(found, arguments.x_azimuth)[0].figure, arguments.picture, dpi=150)
