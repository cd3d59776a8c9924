// The tests that make a pair a candidate, and which of them is cheaper.
#pragma once

namespace onset {

struct MeshData;
struct Motion;

// When two boxes, closed and widened outward, overlap (docs/theory.md, L29):
// - swept: the boxes of the whole motion overlap.
// - both_ends: no axis separates them on the same side at both ends of the step. It is a subset of swept, up
//   to outward rounding.
// - moving: in addition the boxes, each moving linearly from start to end, are together at some time, give or
//   take 2^-45 of it. It pays where things move by more than twice their size.
enum class BoxTest { swept, both_ends, moving };

// Returns both_ends or moving, whichever is likely to make the step cheaper. It samples the moving edges and
// does not depend on earlier calls.
BoxTest cheaper_box_test(const MeshData& mesh, const Motion& motion);

}  // namespace onset
