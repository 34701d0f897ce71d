#!/usr/bin/env python3
"""Writes jobs/rock.obj and jobs/rock_contacts.csv: the mesh of an invented rock, 2.3 m high on a narrow foot, and five
points of contact at different heights. generate_rock.py FOLDER writes them there."""

import pathlib
import sys

import numpy as np

DIVISIONS = 3  # of the edges of an icosahedron into halves
HALF_AXES = (0.75, 0.6, 1.2)  # [m]
FOOT = -0.95  # its height [m]
CONTACTS = 5


def sphere():
    """Returns points and triangles of an icosahedron whose faces are divided, on the unit sphere."""
    golden = (1 + 5**0.5) / 2
    points = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0), (0, -1, golden), (0, 1, golden),
              (0, -1, -golden), (0, 1, -golden), (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]
    points = [np.array(point) / np.linalg.norm(point) for point in points]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7),
             (9, 8, 1)]
    for _ in range(DIVISIONS):
        middles = {}

        def middle(a, b):
            key = min(a, b), max(a, b)
            if key not in middles:
                points.append((points[a] + points[b]) / np.linalg.norm(points[a] + points[b]))
                middles[key] = len(points) - 1
            return middles[key]
        faces = [face for a, b, c in faces for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
                 for face in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    return np.array(points), np.array(faces)


def rock():
    """Returns the points [m], rounded to 0.1 mm, the triangles and the contacts."""
    points, faces = sphere()
    x, y, z = points.T
    bumps = 1 + 0.06 * np.sin(3 * x + 2 * y + 1) * np.cos(4 * y - x) + 0.05 * np.sin(5 * z + 2 * x)
    points = points * bumps[:, None] * HALF_AXES
    ground = FOOT + 0.06 * np.sin(4 * points[:, 0] + 3 * points[:, 1] + 1)
    is_foot = points[:, 2] < ground
    points[:, 2] = np.maximum(points[:, 2], ground)
    points = points.round(4) + 0.0
    foot = points[is_foot]
    sector = np.floor(CONTACTS * (np.arctan2(foot[:, 1], foot[:, 0]) / (2 * np.pi) + 0.5))
    contacts = [max(foot[sector == i].tolist(), key=lambda point: np.hypot(*point[:2])) for i in range(CONTACTS)]
    return points, faces, contacts


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2] / "jobs")
    points, faces, contacts = rock()
    lines = ["# tools/examples/generate_rock.py: no real rock; coordinates in m, z is up"]
    lines += ["v {:.4f} {:.4f} {:.4f}".format(*point) for point in points]
    lines += ["f {} {} {}".format(*face) for face in faces + 1]
    (folder / "rock.obj").write_text("\n".join(lines) + "\n")
    rows = ["x,y,z", *("{:.4f},{:.4f},{:.4f}".format(*contact) for contact in contacts)]
    (folder / "rock_contacts.csv").write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
