"""A picture of an active set: a ball falls on a wavy sheet.

    python picture.py [active_set.png]
"""

import sys

import numpy as np
import onset_ccd
from onset_ccd.show import draw_active_set, png


def sheet(n):
    u, v = (a.ravel() for a in np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij"))
    ids = np.arange(n * n).reshape(n, n)
    a, b, c, d = ids[:-1, :-1].ravel(), ids[1:, :-1].ravel(), ids[1:, 1:].ravel(), ids[:-1, 1:].ravel()
    return np.column_stack([u, v, 0.05 * np.sin(6 * u) * np.sin(5 * v)]), np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def ball(radius, centre, n):
    """Rings of 2 n vertices from pole to pole."""
    rings = [(np.pi * i / n, np.pi * j / n) for i in range(1, n) for j in range(2 * n)]
    x = np.array([[0, 0, 1], *[[np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)] for a, b in rings], [0, 0, -1]])
    faces = []
    for j in range(2 * n):
        k = (j + 1) % (2 * n)
        faces += [(0, 1 + j, 1 + k), (len(x) - 1, len(x) - 1 - 2 * n + k, len(x) - 1 - 2 * n + j)]
        for i in range(n - 2):
            a, b = 1 + 2 * n * i + j, 1 + 2 * n * i + k
            faces += [(a, a + 2 * n, b + 2 * n), (a, b + 2 * n, b)]
    return radius * x + centre, np.array(faces)


def main(path):
    (x, faces), (ball_x, ball_faces) = sheet(24), ball(0.3, [0.5, 0.5, 0.6], 16)
    start = np.vstack([x, ball_x])
    end = start.copy()
    end[len(x):] += [0.1, 0, -0.55]
    mesh = onset_ccd.Mesh(start, np.vstack([faces, ball_faces + len(x)]))
    found = onset_ccd.construct_active_set(mesh, start, end)
    image = png(lambda plotter: draw_active_set(plotter, mesh, start, end, found))
    with open(path, "wb") as file:
        file.write(image)
    print(f"{path}: {len(found)} contacts, the first at t = {found.earliest().toi:.6f}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "active_set.png")
