"""onset/compat/ipc.hpp and ipctk on the same scenes: the same verdicts, steps as long up to both libraries' safety margins, and no
intersection where a step ends."""

import pathlib
import subprocess
import sys
import tempfile

import ipctk
import numpy as np


def soup(random, triangles, speed):
    centres = random.uniform(-1, 1, (triangles, 1, 3))
    x0 = (centres + random.uniform(-0.15, 0.15, (triangles, 3, 3))).reshape(-1, 3)
    return x0, x0 + random.uniform(-speed, speed, x0.shape), np.arange(3 * triangles, dtype=np.int32).reshape(-1, 3)


def particles(random, triangles, count, speed):
    """Vertices of no face: they meet each other, and the soup."""
    x0, x1, faces = soup(random, triangles, speed)
    points = random.uniform(-0.5, 0.5, (count, 3))
    return (np.vstack([x0, points]), np.vstack([x1, points + random.uniform(-speed, speed, points.shape)]), faces)


def grid(n, height, bump=0.0):
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    z = height + bump * np.sin(7 * x) * np.cos(5 * y)
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)[None, :]).ravel()
    faces = np.concatenate([np.stack([i, i + n, i + 1], 1), np.stack([i + 1, i + n, i + n + 1], 1)])
    return np.stack([x, y, z], 2).reshape(-1, 3), faces.astype(np.int32)


def sheets(random, drop):
    lower, faces = grid(9, 0.0, 0.02)
    upper, _ = grid(9, 0.1, 0.03)
    upper = upper + [0.013, 0.017, 0]
    x0 = np.vstack([lower, upper])
    x1 = x0.copy()
    x1[len(lower):] += [0, 0, -drop] + random.uniform(-0.01, 0.01, upper.shape)
    return x0, x1, np.vstack([faces, faces + len(lower)]).astype(np.int32)


def ours(program, scene, distance):
    x0, x1, faces = scene
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "scene")
        path.write_bytes(np.array([len(x0), len(faces)], np.int64).tobytes() + x0.tobytes() + x1.tobytes() +
                         faces.tobytes())
        out = subprocess.run([program, path, repr(distance)], capture_output=True, text=True, check=True).stdout.split()
    return float(out[0]), float(out[1]), out[2] == "1", int(out[3]), float(out[4])


def fail(name, *what):
    sys.exit(" ".join(map(str, (name, *what))))


def least_distance(candidates, mesh, x):
    squares = [candidates[i].compute_distance(candidates[i].dof(x, mesh.edges, mesh.faces)) for i in range(len(candidates))]
    return min(squares, default=1) ** 0.5


def start_is_free(mesh, x0, distance):
    """Apart by more than the separation: ipctk answers 0 otherwise, and a step from contact is judged elsewhere."""
    candidates = ipctk.Candidates()
    candidates.build(mesh, x0, distance + 1e-3)
    return not ipctk.has_intersections(mesh, x0) and least_distance(candidates, mesh, x0) > distance + 1e-5


def compare(program, name, scene, distance, tally):
    x0, x1, faces = scene
    f = np.asfortranarray
    mesh = ipctk.CollisionMesh(f(x0), f(ipctk.edges(f(faces))), f(faces))
    if not start_is_free(mesh, f(x0), distance):
        tally["skipped"] += 1
        return
    step, listed, free, pairs, filtered = ours(program, scene, distance)
    theirs = ipctk.compute_collision_free_stepsize(mesh, f(x0), f(x1), distance)
    theirs_free = ipctk.is_step_collision_free(mesh, f(x0), f(x1), distance)
    candidates = ipctk.Candidates()
    candidates.build(mesh, f(x0), f(x1), distance / 2)
    kept = candidates.compute_collision_free_stepsize(mesh, f(x0), f(x1), distance)
    # Both keep a fifth of each gap, ipctk no more than about 1e-4 of it: onset's steps are shorter where pairs pass each
    # other closely.
    if free != theirs_free and min(step, theirs) < 0.79:
        closest = min(least_distance(candidates, mesh, f(x0 + t * (x1 - x0))) for t in np.linspace(0, 1, 1001))
        if not free or closest <= distance:  # else a false alarm of ipctk's
            fail(name, "free:", free, "ipctk:", theirs_free, "closest:", closest)
    if not 0 < step <= 1:
        fail(name, "step", step, "free", free)
    # Of pairs that pass each other more are listed (by swept boxes) than a step looks at, and all keep their share.
    if listed > step + 1e-9 or (not free and listed < step - 1e-9):
        fail(name, "step", step, "that of its candidates", listed)
    if not 0.3 * theirs <= step:
        fail(name, "step", step, "ipctk's", theirs, kept)
    if filtered < listed - 1e-9:
        fail(name, "with fewer pairs the step", filtered, "is shorter than", listed)
    if ipctk.has_intersections(mesh, f(x0 + step * (x1 - x0))):
        fail(name, "intersects at its step", step)
    # What is certified ends before the first time at which ipctk finds an intersection.
    for t in np.linspace(0, 1, 33)[1:]:
        if ipctk.has_intersections(mesh, f(x0 + t * (x1 - x0))):
            if step > t or free:
                fail(name, "step", step, "but it intersects at", t)
            break
    tally["scenes"] += 1
    tally["contacts"] += not free
    tally["ratios"].append(step / theirs if theirs > 0 else 1.0)


def main():
    program = sys.argv[1]
    random = np.random.default_rng(20210501)
    tally = {"scenes": 0, "contacts": 0, "skipped": 0, "ratios": []}
    for i in range(40):
        distance = [0.0, 1e-3][i % 2]
        compare(program, f"soup {i}", soup(random, 10 + i // 4, 0.02 if i % 5 == 0 else 0.2), distance, tally)
    for i in range(16):
        compare(program, f"sheets {i}", sheets(random, [0.02, 0.06, 0.2, 0.5][i % 4]), [0.0, 1e-3][i // 4 % 2], tally)
    for i in range(16):
        compare(program, f"particles {i}", particles(random, 1 + i // 8, 12, 0.4), [0.01, 0.03][i % 2], tally)
    ratios = tally["ratios"]
    print(f"{tally['scenes']} scenes, {tally['contacts']} with contact, {tally['skipped']} skipped (they begin in contact); "
          f"onset's step / ipctk's: median {np.median(ratios):.3f}, least {min(ratios):.3f}, most {max(ratios):.3f}")
    if tally["scenes"] < 20 or tally["contacts"] < 10:
        sys.exit("too few scenes to tell")
    if np.median(ratios) < 0.75:
        sys.exit("steps are much shorter than ipctk's")


main()
