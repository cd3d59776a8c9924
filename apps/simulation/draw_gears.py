#!/usr/bin/env python3
"""docs/images/gears.png: two gears that run in each other, and where linear paths of their vertices would be.

    apps/simulation/draw_gears.py [PNG]

The gears are those of tests/trajectory/gears.hpp; matplotlib is that of PyPI.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TEETH, BORE, ROOT, TIP, AXLE = 12, 0.4, 0.82, 1.06, 0.38
SHARES = np.array([-0.21, -0.09, 0.09, 0.21])
ANGLE = np.pi / 3  # of the first gear in the step; the other turns as far the other way


def gear(turned):
    """The outline and the bore of a gear about the origin, as rows of points."""
    angles = (turned + 2 * np.pi * (np.arange(TEETH)[:, None] + SHARES) / TEETH).ravel()
    radii = np.tile([ROOT, TIP, TIP, ROOT], TEETH)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    return radii[:, None] * circle, BORE * circle


def turned(points, angle):
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s], [-s, c]])


def draw(axes, points, centre, **style):
    closed = np.vstack([points, points[:1]]) + centre
    axes.plot(closed[:, 0], closed[:, 1], **style)


def panel(axes, t, linear, title):
    for start, angle, centre, colour in (
        (0, ANGLE, (0, 0), "tab:blue"),
        (np.pi + np.pi / TEETH, -ANGLE, (2, 0), "tab:orange"),
    ):
        axes.add_patch(plt.Circle(centre, AXLE, color="0.8"))
        for points in gear(start):
            end = turned(points, angle)
            at = points + t * (end - points) if linear else turned(points, t * angle)
            draw(axes, at, centre, color=colour, linewidth=1)
            hits = np.linalg.norm(at, axis=1) < AXLE
            hit = at[hits] + centre
            axes.plot(hit[:, 0], hit[:, 1], "x", color="tab:red", markersize=4)
    axes.set_title(title, fontsize=9)
    axes.set_xlim(-1.15, 3.15)
    axes.set_ylim(-1.15, 1.15)
    axes.set_aspect("equal")
    axes.axis("off")


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else "docs/images/gears.png"
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 2.6), layout="constrained")
    panel(left, 0.5, False, "half of the step, as the gears turn: free")
    panel(right, 0.5, True, "half of the step, by linear paths: the bores are inside the axles")
    figure.savefig(path, dpi=110, metadata={"Software": None})


if __name__ == "__main__":
    main()
