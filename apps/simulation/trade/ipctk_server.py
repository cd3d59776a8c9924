#!/usr/bin/env python3
"""ipctk as a collision server of the simulators (apps/simulation/collision_server.hpp).

    onset_cloth ... --collision-server "python3 ipctk_server.py TightInclusionCCD"

The argument is the narrow phase, with ipctk's defaults: TightInclusionCCD or AdditiveCCD. One thread; the seconds of an answer are CPU seconds
of compute_collision_free_stepsize alone. Of a step of 0 the first pair that does not let it begin is named.
"""

import struct
import sys
import time

import ipctk
import numpy as np


def read(size):
    data = sys.stdin.buffer.read(size)
    if len(data) < size:
        sys.exit(0)  # the simulator is done
    return data


def read_mesh():
    vertices, edges, faces = struct.unpack("<3q", read(24))
    x = np.frombuffer(read(24 * vertices), "<f8").reshape(-1, 3)
    e = np.frombuffer(read(8 * edges), "<i4").reshape(-1, 2)
    f = np.frombuffer(read(12 * faces), "<i4").reshape(-1, 3)
    return ipctk.CollisionMesh(*(np.asfortranarray(part) for part in (x, e, f)))


def first_blocked(mesh, x_t0, x_t1, ccd):
    """In words: the first pair whose time of impact is 0."""
    candidates = ipctk.Candidates()
    candidates.build(mesh, x_t0, x_t1, 0.0, ipctk.LBVH())
    for i in range(len(candidates)):
        candidate = candidates[i]
        ids = [v for v in candidate.vertex_ids(mesh.edges, mesh.faces) if v >= 0]
        collides, toi = candidate.ccd(x_t0[ids].ravel(), x_t1[ids].ravel(), narrow_phase_ccd=ccd)
        if collides and toi == 0:
            kind = "vertex_face" if isinstance(candidate, ipctk.FaceVertexCandidate) else "edge_edge"
            return " ".join(map(str, [kind, *ids]))
    return "no pair by itself"


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in ("TightInclusionCCD", "AdditiveCCD"):
        sys.exit(__doc__)
    ipctk.set_num_threads(1)
    ccd = getattr(ipctk, sys.argv[1])()
    mesh = read_mesh()
    size = 24 * mesh.num_vertices
    while True:
        x_t0, x_t1 = (np.asfortranarray(np.frombuffer(read(size), "<f8").reshape(-1, 3)) for _ in range(2))
        start = time.process_time()
        step = ipctk.compute_collision_free_stepsize(mesh, x_t0, x_t1, 0.0, ipctk.LBVH(), ccd)
        seconds = time.process_time() - start
        words = first_blocked(mesh, x_t0, x_t1, ccd).encode() if step == 0 else b""
        sys.stdout.buffer.write(struct.pack("<2di", step, seconds, len(words)) + words)
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
