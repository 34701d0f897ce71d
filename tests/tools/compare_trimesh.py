#!/usr/bin/env python3
"""Compares the mass properties of random concave rocks with those of trimesh (PyPI), and reads the files that it writes.
Requires trimesh, NumPy, SciPy and meshio. compare_trimesh.py [ROCKS [SEED]]"""

import pathlib
import sys
import tempfile

import numpy as np
import trimesh

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(CHECKOUT / "tools"), str(CHECKOUT / "tools" / "examples")]

import generate_rock
from overturn import rock

VOLUME, INERTIA = 1e-12, 1e-10  # relative differences of sums of thousands of terms
SINGLE = 1e-5  # the same after rounding of the coordinates to single precision or eight digits


def random_rock(draw):
    """Returns a sphere with bumps as deep as a third of its radius, turned at random, and its faces."""
    points, faces = generate_rock.sphere()
    waves = draw.normal(0, 3, (5, 3))
    radius = 1 + sum(0.07 * np.sin(points @ wave + phase) for wave, phase in zip(waves, draw.uniform(0, 6, 5)))
    turn = np.linalg.qr(draw.normal(size=(3, 3)))[0]
    return (points * radius[:, None] * draw.uniform(0.3, 2, 3)) @ (turn * np.linalg.det(turn)), faces


def difference(found, mesh):
    """Returns the relative differences of the volume and of the inertia."""
    inertia = mesh.moment_inertia / mesh.volume
    return abs(abs(found[0]) / mesh.volume - 1), np.abs(found[2] - inertia).max() / np.abs(inertia).max()


def main():
    rocks, seed = (int(word) for word in (sys.argv[1:] + ["100", "1"][len(sys.argv) - 1:]))
    draw = np.random.default_rng(seed)
    worst = np.zeros((2, 2))
    with tempfile.TemporaryDirectory() as folder:
        for number in range(rocks):
            points, faces = random_rock(draw)
            mesh = trimesh.Trimesh(points, faces, process=False)
            worst[0] = np.maximum(worst[0], difference(rock.mass_properties(points[faces]), mesh))
            suffix, how = ((".obj", {}), (".ply", {"encoding": "binary"}), (".ply", {"encoding": "ascii"}), (".stl", {}),
                           (".stl", {"file_type": "stl_ascii"}))[number % 5]
            path = f"{folder}/rock{suffix}"
            mesh.export(path, **how)
            corners = (lambda read, triangles: read[triangles])(*rock.read_mesh(path))
            worst[1] = np.maximum(worst[1], difference(rock.mass_properties(corners), mesh))
    print(f"{rocks} rocks: largest difference of the volume {worst[0, 0]:.1e}, of the inertia {worst[0, 1]:.1e}; "
          f"of files that trimesh wrote {worst[1, 0]:.1e}, {worst[1, 1]:.1e}")
    if not (worst[0, 0] < VOLUME and worst[0, 1] < INERTIA and (worst[1] < SINGLE).all()):
        sys.exit("compare_trimesh: the mass properties differ from those of trimesh")


if __name__ == "__main__":
    main()
