"""onset's truncate_step and ipctk's planar_filter_step (1.6.1) on the same trials: the share of the motion that each keeps, and
the pairs that cross on the way to what is stored, counted exactly.

    truncate_beside_ipctk.py TRUNCATED_STEPS [TRIALS]

Both keep a tenth of each gap. ipctk's radius is half of the longest way, that, and twice that.
"""

import pathlib
import subprocess
import sys
import tempfile

import ipctk
import numpy as np

GAP_SHARE = 0.1


def soup(random, triangles, size):
    """Triangles that do not intersect, one added at a time."""
    parts = []
    while len(parts) < triangles:
        parts.append(random.uniform(-0.5, 0.5, 3) + random.uniform(-size, size, (3, 3)))
        x = np.asfortranarray(np.vstack(parts))
        faces = np.asfortranarray(np.arange(3 * len(parts), dtype=np.int32).reshape(-1, 3))
        if ipctk.has_intersections(ipctk.CollisionMesh(x, ipctk.edges(faces), faces), x):
            parts.pop()
    return np.vstack(parts), np.arange(3 * triangles, dtype=np.int32).reshape(-1, 3)


def sheets(random, n, layers, gap):
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)[None, :]).ravel()
    faces = np.concatenate([np.stack([i, i + n, i + 1], 1), np.stack([i + 1, i + n, i + n + 1], 1)])
    positions, all_faces = [], []
    for k in range(layers):
        z = k * gap + random.uniform(-0.2, 0.2, x.shape) * gap
        positions.append(np.stack([x + 0.013 * k, y + 0.007 * k, z], 2).reshape(-1, 3))
        all_faces.append(faces + k * n * n)
    return np.vstack(positions), np.vstack(all_faces).astype(np.int32)


def trials(random, count, speed, scale, gap):
    for i in range(count):
        x, faces = soup(random, 20, 0.25) if i % 2 else sheets(random, 5, 3, gap)
        yield scale * x, scale * (x + random.uniform(-speed, speed, x.shape)), faces


def theirs(x0, x1, faces, radius):
    f = np.asfortranarray
    mesh = ipctk.CollisionMesh(f(x0), ipctk.edges(f(faces)), f(faces))
    region = ipctk.ogc.TrustRegion(radius)
    region.relaxed_radius_scaling = 1 - GAP_SHARE
    region.update(mesh, f(x0), ipctk.NormalCollisions())
    dx = f(x1 - x0)
    region.planar_filter_step(mesh, f(x0), dx)
    return x0 + dx


def kept(scene, end):
    x0, x1, _ = scene
    return np.linalg.norm(end - x0, axis=1).sum() / np.linalg.norm(x1 - x0, axis=1).sum()


class Program:
    def __init__(self, path, scenes):
        self.path, self.folder = path, tempfile.TemporaryDirectory()
        self.scenes = pathlib.Path(self.folder.name, "scenes")
        self.shapes = [len(x0) for x0, _, _ in scenes]
        with self.scenes.open("wb") as out:
            for x0, x1, faces in scenes:
                out.write(np.array([len(x0), len(faces)], np.int64).tobytes() + x0.tobytes() + x1.tobytes() + faces.tobytes())

    def run(self, *arguments):
        return subprocess.run([self.path, *map(str, arguments)], capture_output=True, text=True, check=True).stdout

    def truncate(self):
        ends = pathlib.Path(self.folder.name, "ends")
        self.run("truncate", self.scenes, ends, GAP_SHARE)
        rows = np.frombuffer(ends.read_bytes()).reshape(-1, 3)
        return np.split(rows, np.cumsum(self.shapes)[:-1])

    def crossings(self, ends):
        path = pathlib.Path(self.folder.name, "theirs")
        path.write_bytes(b"".join(np.ascontiguousarray(end).tobytes() for end in ends))
        lines = [line.split() for line in self.run("crossings", self.scenes, path).splitlines()]
        return sum(int(line[0]) for line in lines)


def main():
    program, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 40
    random = np.random.default_rng(20260601)
    failed = False
    for name, speed, scale, gap in [("small motions", 0.01, 1, 0.05), ("large motions", 0.3, 1, 0.05),
                                    ("small, scaled by 1e-8", 0.01, 1e-8, 0.05), ("large, scaled by 1e8", 0.3, 1e8, 0.05),
                                    ("gaps of 1e-9", 0.01, 1, 1e-9), ("gaps of 5e-11", 0.01, 1, 5e-11),
                                    ("gaps of 1e-13", 0.01, 1, 1e-13)]:
        scenes = list(trials(random, count, speed, scale, gap))
        peer = Program(program, scenes)
        ours = peer.truncate()
        rows = [("onset", ours)]
        for factor in (0.5, 1, 2):
            longest = [np.linalg.norm(x1 - x0, axis=1).max() for x0, x1, _ in scenes]
            rows.append((f"ipctk, radius {factor}", [theirs(*s, factor * way) for s, way in zip(scenes, longest)]))
        shares = {who: np.mean([kept(s, e) for s, e in zip(scenes, ends)]) for who, ends in rows}
        crossings = {who: peer.crossings(ends) for who, ends in rows}
        print(f"{name}: " + "; ".join(f"{who} keeps {shares[who]:.3f}, crossings {crossings[who]}" for who, _ in rows), flush=True)
        safe = [shares[who] for who in shares if who != "onset" and crossings[who] == 0]
        failed |= crossings["onset"] > 0 or any(share > shares["onset"] for share in safe)
    if failed:
        sys.exit("onset crosses, or keeps less than ipctk where that does not cross")


main()
