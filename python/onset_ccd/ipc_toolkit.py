"""Onset inside ipctk: a narrow phase and a broad phase to pass to its functions, for codes that keep its energies.

    import ipctk
    from onset_ccd import ipc_toolkit

    ipctk.set_num_threads(1)
    candidates = ipctk.Candidates()
    candidates.build(mesh, x_t0, x_t1, inflation_radius, ipc_toolkit.BroadPhase())
    step = candidates.compute_collision_free_stepsize(mesh, x_t0, x_t1, 0.0, ipc_toolkit.NarrowPhaseCCD())

ipctk asks pair by pair, and from Python's side of it: this is as slow as the interpreter. compute_collision_free_stepsize of this
package does the whole of it at once.
"""

import ipctk
import numpy as np

from . import _onset
from ._onset import PairKind

__all__ = ["BroadPhase", "NarrowPhaseCCD"]


class NarrowPhaseCCD(ipctk.NarrowPhaseCCD):
    """Onset's queries of one pair, with the parameters of ipctk.TightInclusionCCD.

    A time of impact is never later than the exact one, and the pair keeps 1 - conservative_rescaling of its gap. This is of the exact
    motion; storing x + toi dx is not looked at. ValueError for values out of range; NaN and infinities give 0.

    ipctk holds the interpreter's lock while its threads ask, so that with more than one of them a call would wait for ever: RuntimeError
    here unless ipctk.set_num_threads(1) was called before. Leave it at 1 as long as this is used.
    """

    def __init__(self, tolerance=ipctk.TightInclusionCCD.DEFAULT_TOLERANCE, max_iterations=ipctk.TightInclusionCCD.DEFAULT_MAX_ITERATIONS,
                 conservative_rescaling=ipctk.TightInclusionCCD.DEFAULT_CONSERVATIVE_RESCALING):
        super().__init__()
        self._require_one_thread()
        self.tolerance, self.max_iterations, self.conservative_rescaling = tolerance, max_iterations, conservative_rescaling

    @staticmethod
    def _require_one_thread():
        if ipctk.get_num_threads() != 1:
            raise RuntimeError("a narrow phase in Python needs one thread in ipctk, which would wait for itself: ipctk.set_num_threads(1)")

    def _ask(self, kind, t0, t1, min_distance, tmax):
        toi = _onset._time_of_impact(kind, np.array(t0), np.array(t1), min_distance, tmax, self.conservative_rescaling, self.tolerance,
                                     int(self.max_iterations), int(ipctk.TightInclusionCCD.DEFAULT_MAX_ITERATIONS))
        return toi <= tmax, toi

    def point_point_ccd(self, p0_t0, p1_t0, p0_t1, p1_t1, min_distance=0.0, tmax=1.0):
        if np.size(p0_t0) == 2:
            return self._ask(PairKind.vertex_edge, [p0_t0, p1_t0, p1_t0], [p0_t1, p1_t1, p1_t1], min_distance, tmax)
        return self._ask(PairKind.edge_edge, [p0_t0, p0_t0, p1_t0, p1_t0], [p0_t1, p0_t1, p1_t1, p1_t1], min_distance, tmax)

    def point_edge_ccd(self, p_t0, e0_t0, e1_t0, p_t1, e0_t1, e1_t1, min_distance=0.0, tmax=1.0):
        if np.size(p_t0) == 2:
            return self._ask(PairKind.vertex_edge, [p_t0, e0_t0, e1_t0], [p_t1, e0_t1, e1_t1], min_distance, tmax)
        return self._ask(PairKind.edge_edge, [p_t0, p_t0, e0_t0, e1_t0], [p_t1, p_t1, e0_t1, e1_t1], min_distance, tmax)

    def point_triangle_ccd(self, p_t0, t0_t0, t1_t0, t2_t0, p_t1, t0_t1, t1_t1, t2_t1, min_distance=0.0, tmax=1.0):
        return self._ask(PairKind.vertex_face, [p_t0, t0_t0, t1_t0, t2_t0], [p_t1, t0_t1, t1_t1, t2_t1], min_distance, tmax)

    def edge_edge_ccd(self, ea0_t0, ea1_t0, eb0_t0, eb1_t0, ea0_t1, ea1_t1, eb0_t1, eb1_t1, min_distance=0.0, tmax=1.0):
        return self._ask(PairKind.edge_edge, [ea0_t0, ea1_t0, eb0_t0, eb1_t0], [ea0_t1, ea1_t1, eb0_t1, eb1_t1], min_distance, tmax)


class BroadPhase(ipctk.BroadPhase):
    """Onset's broad phase over swept boxes: the pairs whose boxes meet, without a common vertex, that can_vertices_collide lets meet.

    Boxes are wider than those of ipctk.BruteForce by a rounding, so that none of its pairs is missing. Lists are sorted. build raises
    ValueError for positions that are not finite.
    """

    def name(self):
        return "Onset"

    def build(self, *arguments, inflation_radius=0.0, **named):
        """As ipctk.BroadPhase.build: (vertices, edges, faces) or (vertices_t0, vertices_t1, edges, faces), and inflation_radius."""
        given = [*arguments, *(named[name] for name in ("vertices", "vertices_t0", "vertices_t1", "edges", "faces") if name in named)]
        if len(given) in (4, 5) and np.ndim(given[-1]) == 0:
            inflation_radius = given.pop()
        if len(given) not in (3, 4):
            raise TypeError("BroadPhase.build: one or two arrays of positions, edges, faces and inflation_radius are expected")
        *positions, edges, faces = given
        radius = float(inflation_radius)
        positions = [np.asarray(x, float) for x in positions]
        edges, faces = (np.reshape(np.asarray(ids, int), (-1, n)) for ids, n in ((edges, 2), (faces, 3)))
        if any(x.ndim != 2 or x.shape != positions[0].shape for x in positions) or not radius >= 0:
            raise ValueError("BroadPhase.build: positions are #V x dim, the same at both ends, and inflation_radius is not below 0")
        for name, ids in (("edges", edges), ("faces", faces)):
            if ids.size and not (0 <= ids.min() and ids.max() < len(positions[0])):
                raise ValueError(f"BroadPhase.build: {name} name vertices that are not there")
        if not all(np.isfinite(x).all() for x in positions):
            raise ValueError("BroadPhase.build: a position is not finite")
        super().build(*positions, edges, faces, radius)
        lo, hi = np.minimum.reduce(positions), np.maximum.reduce(positions)
        lo, hi = np.nextafter(lo - radius, -np.inf), np.nextafter(hi + radius, np.inf)
        flat = ((0, 0), (0, 3 - lo.shape[1]))
        lo, hi = np.pad(lo, flat), np.pad(hi, flat)
        self._ids = {"vertex": np.arange(len(lo))[:, None], "edge": edges, "face": faces}
        self._boxes = {kind: np.hstack([lo[ids].min(axis=1), hi[ids].max(axis=1)]) for kind, ids in self._ids.items()}

    def clear(self):
        super().clear()
        self._boxes = {}

    def _pairs(self, first, second):
        if not getattr(self, "_boxes", None):
            return
        can = self.can_vertices_collide
        found = _onset._overlapping_boxes(self._boxes[first], None if first == second else self._boxes[second])
        a, b = self._ids[first][found[:, 0]], self._ids[second][found[:, 1]]
        apart = ~(a[:, :, None] == b[:, None, :]).any(axis=(1, 2))
        for (i, j), p, q in zip(found[apart].tolist(), a[apart].tolist(), b[apart].tolist()):
            if any(can(u, v) for u in p for v in q):
                yield i, j

    def detect_vertex_vertex_candidates(self):
        return [ipctk.VertexVertexCandidate(i, j) for i, j in self._pairs("vertex", "vertex")]

    def detect_edge_vertex_candidates(self):
        return [ipctk.EdgeVertexCandidate(i, j) for i, j in self._pairs("edge", "vertex")]

    def detect_edge_edge_candidates(self):
        return [ipctk.EdgeEdgeCandidate(i, j) for i, j in self._pairs("edge", "edge")]

    def detect_face_vertex_candidates(self):
        return [ipctk.FaceVertexCandidate(i, j) for i, j in self._pairs("face", "vertex")]

    def detect_edge_face_candidates(self):
        return [ipctk.EdgeFaceCandidate(i, j) for i, j in self._pairs("edge", "face")]

    def detect_face_face_candidates(self):
        return [ipctk.FaceFaceCandidate(i, j) for i, j in self._pairs("face", "face")]
