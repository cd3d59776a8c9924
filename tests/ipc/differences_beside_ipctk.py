"""What docs/from-ipc-toolkit.md says of ipctk 1.6.1's answers where Onset's differ: prints them, and ends with 1 where they are others.
Onset's own are asserted by test_queries.cpp and test_candidates.cpp, on the same pairs."""

import sys

import ipctk
import numpy as np

f = np.asfortranarray


def oblique(start, end, distance):
    """A point above a triangle with normal (1, 1, 1)."""
    n, a, b = np.array([1, 1, 1]) / 3**0.5, np.array([1, -1, 0.0]), np.array([0, 1, -1.0])
    return ipctk.TightInclusionCCD().point_triangle_ccd(start * n, a, b, -a - b, end * n, a, b, -a - b, distance)


def two_points():
    x = f(np.array([[0, 0, 0], [1, 0, 0.0]]))
    mesh, candidates = ipctk.CollisionMesh(x), ipctk.Candidates()
    candidates.build(mesh, x, 2.0)
    return candidates.compute_per_vertex_safe_distances(mesh, x, 2.0, 0.0)


def far_apart(dhat=1e-3):
    """A triangle that passes through another one, which is a thousand dhat away at the start."""
    x = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 1], [2, 1, 1], [1, 2, 1.0]])
    moved = x.copy()
    moved[3:, 2] -= 2
    faces = f(np.array([[0, 1, 2], [3, 4, 5]], dtype=np.int32))
    mesh, candidates = ipctk.CollisionMesh(f(x), ipctk.edges(faces), faces), ipctk.Candidates()
    candidates.build(mesh, f(x), dhat / 2)
    return (candidates.compute_noncandidate_conservative_stepsize(mesh, f(moved - x), dhat),
            candidates.compute_cfl_stepsize(mesh, f(x), f(moved), dhat))


def main():
    late, missed, parting = oblique(0.012, 0, 0.01), oblique(0.011, 0.009, 0.01), oblique(0.009, 0.02, 0.01)
    safe, (noncandidate, cfl) = two_points(), far_apart()
    print(f"from 0.012 to 0, distance 0.01 reached at 1/6: {late}")
    print(f"from 0.011 to 0.009, distance 0.01 reached at 1/2: {missed}")
    print(f"from 0.009 to 0.02 with distance 0.01: {parting}")
    print(f"safe distances of two points 1 apart: {safe}")
    print(f"first contact at 1/2: step of what is no candidate {noncandidate}, CFL step {cfl}")
    holds = [late[0] and late[1] > 1 / 6, not missed[0], parting == (True, 0.0), list(safe) == [1, 1], noncandidate == 1, cfl == 1]
    if not all(holds):
        sys.exit(f"docs/from-ipc-toolkit.md says otherwise: {holds}")


main()
