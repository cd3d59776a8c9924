"""From ipctk to onset_ccd: the same step, candidates and contacts from both, side by side.

    python from_ipctk.py [VERTICES_A_SIDE]

| ipctk | onset_ccd |
|---|---|
| CollisionMesh(rest, edges, faces) | Mesh(rest, faces), edges if they are not those of igl |
| compute_collision_free_stepsize(mesh, x0, x1, min_distance) | compute_collision_free_stepsize(mesh, x0, x1, min_separation=...).step |
| is_step_collision_free(mesh, x0, x1) | is_step_collision_free(mesh, x0, x1) |
| Candidates.build(mesh, x0, x1) | compute_candidates(mesh, x0, x1) |
| Candidates.build, then ccd() of each | construct_active_set(mesh, x0, x1).contacts |
| has_intersections(mesh, x) | has_intersections(mesh, x), intersections(mesh, x) for a list |
"""

import sys
import time

import ipctk
import numpy as np
import onset_ccd


def scene(n):
    """A sheet with waves falls through another."""
    u, v = (a.ravel() for a in np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij"))
    ids = np.arange(n * n).reshape(n, n)
    a, b, c, d = ids[:-1, :-1].ravel(), ids[1:, :-1].ravel(), ids[1:, 1:].ravel(), ids[:-1, 1:].ravel()
    faces = np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    low = np.column_stack([u, v, 0.05 * np.sin(9 * u + 4 * v)])
    high = np.column_stack([u + 0.013, v + 0.007, 0.4 + 0.05 * np.cos(5 * u - 8 * v)])
    x0 = np.vstack([low, high])
    x1 = x0.copy()
    x1[n * n:, 2] -= 0.45
    return x0, x1, np.vstack([faces, faces + n * n])


def timed(what, call):
    call()  # to warm up
    began = time.perf_counter()
    answer = call()
    print(f"  {what:52} {1e3 * (time.perf_counter() - began):9.2f} ms")
    return answer


def ids_of(candidates):
    """What ipctk's candidates are about, as onset_ccd has pairs: (kind, a, b)."""
    vf = {(0, c.vertex_id, c.face_id) for c in candidates.fv_candidates}
    return vf | {(1, *sorted((c.edge0_id, c.edge1_id))) for c in candidates.ee_candidates}


def contacts_of_ipctk(mesh, edges, faces, x0, x1):
    """Each candidate asked on its own, which ipctk leaves to the caller: {pair: time of impact}."""
    candidates = ipctk.Candidates()
    candidates.build(mesh, x0, x1)
    found = {}
    for c in [*candidates.fv_candidates, *candidates.ee_candidates]:
        hit, toi = c.ccd(c.dof(x0, edges, faces), c.dof(x1, edges, faces))
        if hit:
            vf = isinstance(c, ipctk.FaceVertexCandidate)
            found[(0, c.vertex_id, c.face_id) if vf else (1, *sorted((c.edge0_id, c.edge1_id)))] = toi
    return candidates, found


def main(n):
    x0, x1, faces = scene(n)
    edges = onset_ccd.edges(faces)
    theirs, ours = ipctk.CollisionMesh(np.asfortranarray(x0), edges, faces), onset_ccd.Mesh(x0, faces)
    y0, y1 = np.asfortranarray(x0), np.asfortranarray(x1)
    print(f"{len(x0)} vertices, {len(faces)} faces; times on this machine, of one call after another")

    step_ipctk = timed("ipctk: compute_collision_free_stepsize", lambda: ipctk.compute_collision_free_stepsize(theirs, y0, y1))
    step = timed("onset_ccd: compute_collision_free_stepsize", lambda: onset_ccd.compute_collision_free_stepsize(ours, x0, x1))
    print(f"  steps: ipctk {step_ipctk:.9f}, onset_ccd {step.step:.9f}; the first contact is in [{step.toi:.17g}, {step.toi_hi:.17g}]")
    assert step_ipctk <= step.toi_hi, "ipctk's step is conservative, too"

    candidates, times = timed("ipctk: Candidates.build, then ccd() of each", lambda: contacts_of_ipctk(theirs, edges, faces, y0, y1))
    found = timed("onset_ccd: construct_active_set", lambda: onset_ccd.construct_active_set(ours, x0, x1))
    swept = onset_ccd.compute_candidates(ours, x0, x1)
    print(f"  candidates: ipctk {len(ids_of(candidates))}, onset_ccd {swept.counts.total()}")

    mine = {(int(c["kind"]), int(c["a"]), int(c["b"])): c for c in found.contacts}
    both = times.keys() & mine.keys()
    early = [mine[key]["toi_hi"] - times[key] for key in both]
    certain = [key for key, c in mine.items() if c["certainty"] != int(onset_ccd.Certainty.within_tolerance)]
    print(f"  contacts: ipctk {len(times)}, onset_ccd {len(mine)} ({len(certain)} of them certain), {len(both)} in both")
    print(f"  ipctk's times are earlier than the certain ones by {np.median(early):.2g} (median), {max(early):.2g} at most, of the step")
    assert set(certain) <= times.keys(), "neither misses a contact"


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 24)
