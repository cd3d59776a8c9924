#!/usr/bin/env python3
"""Draws frames that a simulator has written: side by side as one PNG, one after the other as an animated GIF.

  render.py OUT.png FRAME... [--cloth FACES...] [--elevation DEGREES] [--azimuth DEGREES]
  render.py OUT.gif FRAME... [--seconds SECONDS] [likewise]

A .ply of onset_cloth is drawn in two colours, a .vtu of onset_elastic with a colour for each body, in the order of its vertices. An animation
looks at all of its frames from one place.
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import PillowWriter
from mpl_toolkits.mplot3d.art3d import Poly3DCollection


CLOTH, OTHER = [0.35, 0.55, 0.85], [0.85, 0.65, 0.4]
BODIES = [CLOTH, OTHER, [0.45, 0.7, 0.45], [0.8, 0.45, 0.45], [0.6, 0.5, 0.8], [0.5, 0.7, 0.75], [0.8, 0.75, 0.4], [0.6, 0.6, 0.6]]


def read_ply(path):
    """Vertices and faces of a frame, in the one layout that the simulators write."""
    with open(path, "rb") as file:
        counts = {}
        for line in iter(file.readline, b"end_header\n"):
            if not line:
                raise SystemExit(f"{path}: no PLY of a simulator")
            words = line.split()
            if words[0] == b"element":
                counts[words[1]] = int(words[2])
        points = np.fromfile(file, "<f8", 3 * counts[b"vertex"]).reshape(-1, 3)
        faces = np.fromfile(file, [("n", "u1"), ("v", "<i4", 3)], counts[b"face"])
    return points, faces["v"]


def read_vtu(path):
    """Vertices and tetrahedra of a frame, likewise."""
    with open(path, "rb") as file:
        head, mark, arrays = file.read().partition(b'<AppendedData encoding="raw">\n_')
    if not mark:
        raise SystemExit(f"{path}: no VTU of a simulator")
    values, at = [], 0
    for kind in ("<f8", "<f8", "<i8"):  # positions, velocities, connectivity
        size = int(np.frombuffer(arrays, "<u8", 1, at)[0])
        values.append(np.frombuffer(arrays, kind, size // 8, at + 8))
        at += 8 + size
    return values[0].reshape(-1, 3), values[2].reshape(-1, 4)


def surface(tetrahedra):
    """The faces of one tetrahedron only."""
    faces = tetrahedra[:, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]].reshape(-1, 3)
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[counts == 1]]


def bodies(tetrahedra, vertices):
    """For each vertex the number of its connected part, in the order of their vertices."""
    part = np.arange(vertices)
    while True:  # the least vertex spreads
        least = part[tetrahedra].min(axis=1)
        spread = part.copy()
        np.minimum.at(spread, tetrahedra, least[:, None])
        if (spread == part).all():
            return np.unique(part, return_inverse=True)[1]
        part = spread


def read_frame(path, cloth):
    """Vertices, faces, and a colour for each of them."""
    if path.endswith(".vtu"):
        points, tetrahedra = read_vtu(path)
        faces = surface(tetrahedra)
        return points, faces, np.array(BODIES)[bodies(tetrahedra, len(points))[faces[:, 0]] % len(BODIES)]
    points, faces = read_ply(path)
    return points, faces, np.where((np.arange(len(faces)) < cloth)[:, None], CLOTH, OTHER)


def shown(corners):
    """Which faces: a floor of two triangles would hide all else."""
    return np.ptp(corners, axis=1).max(axis=1) < 1


def draw(axes, frame, is_layered, view, box):
    """box: the least and the largest corner of what is in the picture."""
    points, faces, colours = frame
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-300
    light = np.array([0.3, -0.5, 0.8])
    shade = 0.35 + 0.65 * np.abs(normals @ light / np.linalg.norm(light))
    small = shown(corners)
    is_cloth = (colours == CLOTH).all(axis=1)
    for order, mine in enumerate([small & ~is_cloth, small & is_cloth] if is_layered else [small]):
        if mine.any():  # faces are sorted by their middles: the cloth, which lies outside, is drawn last
            shades = shade[mine][:, None] * colours[mine]
            axes.add_collection3d(Poly3DCollection(corners[mine], facecolors=shades, edgecolors=shades, linewidths=0.3,
                                                   zorder=order))
    centre, half = (box[0] + box[1]) / 2, 0.5 * (box[1] - box[0]).max()
    axes.set_box_aspect((1, 1, 1), zoom=1.6)
    axes.set(xlim=centre[0] + [-half, half], ylim=centre[1] + [-half, half], zlim=centre[2] + [-half, half])
    axes.view_init(*view)
    axes.set_axis_off()


def box_of(frames):
    corners = [points[faces[shown(points[faces])]].reshape(-1, 3) for points, faces, _ in frames]
    return np.min([c.min(axis=0) for c in corners], axis=0), np.max([c.max(axis=0) for c in corners], axis=0)


def side_by_side(output, frames, layered, view):
    figure = plt.figure(figsize=(3 * len(frames), 3))
    for i, frame in enumerate(frames):
        axes = figure.add_subplot(1, len(frames), i + 1, projection="3d", computed_zorder=False)
        draw(axes, frame, layered[i], view, box_of([frame]))
    figure.subplots_adjust(0, 0, 1, 1, 0, 0)
    figure.savefig(output, dpi=80)


def animate(output, frames, layered, view, seconds):
    figure = plt.figure(figsize=(3, 3))
    axes = figure.add_axes((0, 0, 1, 1), projection="3d", computed_zorder=False)
    writer = PillowWriter(fps=len(frames) / seconds)
    with writer.saving(figure, output, dpi=80):
        for frame, is_layered in zip(frames, layered):
            axes.clear()
            draw(axes, frame, is_layered, view, box_of(frames))
            writer.grab_frame()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output")
    parser.add_argument("frames", nargs="+")
    parser.add_argument("--cloth", type=int, nargs="+", default=[1 << 30],
                        help="faces of the cloth, which come first: one number, or one a frame")
    parser.add_argument("--elevation", type=float, default=25)
    parser.add_argument("--azimuth", type=float, default=-60)
    parser.add_argument("--seconds", type=float, default=4, help="of an animation")
    options = parser.parse_args()
    cloth = options.cloth * (len(options.frames) if len(options.cloth) == 1 else 1)
    if len(cloth) != len(options.frames):
        parser.error("--cloth takes one number, or one a frame")
    frames = [read_frame(path, faces) for path, faces in zip(options.frames, cloth)]
    layered = [path.endswith(".ply") for path in options.frames]
    view = (options.elevation, options.azimuth)
    if options.output.endswith(".gif"):
        animate(options.output, frames, layered, view, options.seconds)
    else:
        side_by_side(options.output, frames, layered, view)


if __name__ == "__main__":
    main()
