#!/usr/bin/env python3
"""Draws frames that a simulator has written, side by side, as one PNG.

  render.py OUT.png FRAME.ply... [--cloth FACES...] [--elevation DEGREES] [--azimuth DEGREES]
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection


def read_frame(path):
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


def draw(axes, points, faces, cloth, view):
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-300
    light = np.array([0.3, -0.5, 0.8])
    shade = 0.35 + 0.65 * np.abs(normals @ light / np.linalg.norm(light))
    is_cloth = np.arange(len(faces)) < cloth
    small = np.ptp(corners, axis=1).max(axis=1) < 1  # a floor of two triangles would hide all else
    for order, (mine, colour) in enumerate([(small & ~is_cloth, [0.85, 0.65, 0.4]), (small & is_cloth, [0.35, 0.55, 0.85])]):
        if mine.any():  # faces are sorted by their middles: the cloth, which lies outside, is drawn last
            shades = np.outer(shade[mine], colour)
            axes.add_collection3d(Poly3DCollection(corners[mine], facecolors=shades, edgecolors=shades, linewidths=0.3,
                                                   zorder=order))
    used = corners[small].reshape(-1, 3)
    centre, reach = (used.min(axis=0) + used.max(axis=0)) / 2, np.ptp(used, axis=0)
    half = 0.5 * reach.max()
    axes.set_box_aspect((1, 1, 1), zoom=1.6)
    axes.set(xlim=centre[0] + [-half, half], ylim=centre[1] + [-half, half], zlim=centre[2] + [-half, half])
    axes.view_init(*view)
    axes.set_axis_off()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output")
    parser.add_argument("frames", nargs="+")
    parser.add_argument("--cloth", type=int, nargs="+", default=[1 << 30],
                        help="faces of the cloth, which come first: one number, or one a frame")
    parser.add_argument("--elevation", type=float, default=25)
    parser.add_argument("--azimuth", type=float, default=-60)
    options = parser.parse_args()
    cloth = options.cloth * (len(options.frames) if len(options.cloth) == 1 else 1)
    if len(cloth) != len(options.frames):
        parser.error("--cloth takes one number, or one a frame")
    figure = plt.figure(figsize=(3 * len(options.frames), 3))
    for i, path in enumerate(options.frames):
        axes = figure.add_subplot(1, len(options.frames), i + 1, projection="3d", computed_zorder=False)
        draw(axes, *read_frame(path), cloth[i], (options.elevation, options.azimuth))
    figure.subplots_adjust(0, 0, 1, 1, 0, 0)
    figure.savefig(options.output, dpi=80)


if __name__ == "__main__":
    main()
