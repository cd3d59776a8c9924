// Who may meet whom, and at which distance: the rules of a scene, as data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <onset/export.hpp>
#include <onset/result.hpp>
#include <onset/views.hpp>
#include <vector>

namespace onset {

// A half-space that vertices stay out of: x is free where normal . x > offset, in exact arithmetic for the
// stored doubles. It stands still.
struct Plane {
  // Towards the free side; of any length > 0, finite. Its length is taken into account where distances are
  // measured, without an error.
  std::array<double, 3> normal{0, 0, 1};
  // normal . x of the points of the plane, finite.
  double offset = 0;
  // Bits as CollisionRules::groups and masks have them; a plane meets every vertex by default.
  std::uint32_t group = ~0u, mask = ~0u;
};

// A separation for the pairs of two bodies, or of one body with itself.
struct BodySeparation {
  // Ids >= 0, in any order, the same for pairs within one body.
  int body_a = 0, body_b = 0;
  // Model length, in [0, 2^1020].
  double separation = 0;
};

// What is left empty does not matter; the order in which fields are filled does not either. A mesh checks all
// of it at once (Mesh::set_rules). A pair is left out of every call, and named by none, where any of the
// rules says so; the primitives left with no partner get no box.
struct CollisionRules {
  // Points: vertices of no edge and no face that meet each other, wires and all other edges, as particles
  // with a separation or thickness do. Each becomes an edge {v, v} of length zero, after all others, in the
  // order given: its pairs are edge_edge pairs by the id num_edges() - num_points() + row, whose `vertices`
  // name v twice; the first of the two has the point's whole weight (1 or -1), the second 0. A pair with an
  // edge of a face says no more than the point and that face do.
  std::vector<int> points;

  // Thickness of each vertex (#V values >= 0, model length): a pair must stay apart by
  // Options::min_separation plus the largest thickness among the vertices of each of its two primitives.
  std::vector<double> thickness;
  // Pairs of bodies with a separation of their own, larger or smaller, in place of Options::min_separation;
  // each pair of bodies at most once. The thickness is added to it as well.
  std::vector<BodySeparation> body_separations;

  // The shape in which no pair presses: #V x 3 (in the plane #V x 2), model length, at most
  // 2^1020; it sets no positions. With it, a mesh
  // may be finer than the separation: what a pair must keep is at most rest_share, in (0, 1), times its
  // distance in this shape, in the norm of the call, rounded down. (Options::min_separation, thickness and
  // body_separations say what it must keep else; pairs farther apart at rest than that over rest_share keep
  // all of it.) A pair that touches at rest, or is apart by no more than a few roundings of its size, has
  // separation 0: it still may not touch. Distances up to which pairs are listed (d_hat) stay as they are,
  // and are counted from the separation of each pair. The pairs are found by the first call with a larger
  // separation, or another norm, than those before it, within the budgets of that call (12 bytes a pair of
  // Options::memory_limit, twice as much while they are put in order), and stay with the mesh. They are few
  // where excluded_rings leaves out the neighbours.
  StoredPositions rest_positions;
  double rest_share = 0.5;

  // Bodies: one id >= 0 a vertex (#V values), the same for all vertices of an edge or face; empty: all is
  // body 0. Mesh::components() has the connected parts; Mesh::of_bodies(), which makes values of vertices of
  // values of bodies, goes by the bodies that the mesh has been given already.
  std::vector<int> bodies;
  // One flag a body. Rigid: its parts never meet each other; that it moves rigidly is the caller's business
  // and not checked. Without self-collision: the same of a body that deforms.
  std::vector<bool> rigid_bodies, bodies_without_self_collision;
  // Bodies that pass through each other: #pairs x 2, different ids.
  std::vector<std::array<int, 2>> excluded_bodies;

  // Static vertices (#V flags): they stay where they are, x_t1 = x_t0 in every call (else the call throws,
  // naming the vertex). Pairs all of whose vertices are static are left out. Boxes and tree of the primitives
  // all of whose vertices are static are kept from call to call until one of these vertices is found
  // elsewhere.
  std::vector<bool> static_vertices;

  // Bits of the groups that each vertex is in, and of those that it meets (#V values each, both or none).
  // Primitives have the bits of all of their vertices, and meet if each is in a group that the other one
  // meets.
  std::vector<std::uint32_t> groups, masks;

  // Vertices that are at one place, exactly, at both ends of a motion count as one in it, as the copies of a
  // seam's vertices do: pairs with one of them on each side are left out as if they shared a vertex.
  // Distances at one time (close_pairs) are those of a motion that stays there.
  bool weld = false;
  // Vertices that count as one wherever they are, as copies that drift apart: #pairs x 2, different ids.
  // duplicate_vertices() finds them.
  std::vector<std::array<int, 2>> excluded_vertices;

  // Neighbours on the mesh that never meet: pairs with a vertex of one primitive and a vertex of the other
  // that are joined by at most so many edges (>= 0), edges of faces and wires alike. 0: none but those that
  // share a vertex, which never meet. Copies of a vertex are not joined. Of a surface, n leaves out the faces
  // within the n-th ring of a vertex. At most 2^27 pairs of vertices may be so close, at 4 bytes each.
  int excluded_rings = 0;
  // Planes, each of which meets every vertex, but for static ones and what groups, masks and excluded_pairs
  // leave out; bodies and welds do not matter. What a mesh has behind a plane at the start blocks steps as
  // what touches does. Edges and faces are beyond a plane where their vertices are.
  std::vector<Plane> planes;

  // These very pairs, in every call and at any distance: they may pass through each other from now on. Such
  // as those that check() finds touching at the start. `vertices` are not looked at.
  std::vector<Pair> excluded_pairs;
  // The same for an edge and a face, in intersections(), has_intersections() and check().
  std::vector<Intersection> excluded_intersections;
};

}  // namespace onset
