// The tests that make a pair a candidate, and which of them is cheaper.
#pragma once

namespace onset {

struct MeshData;
struct Motion;

// When two boxes, closed and widened outward, overlap (docs/theory.md, L29):
// - swept: the boxes of the whole motion overlap.
// - both_ends: no axis separates them on one side at both ends; a subset of swept up to outward rounding.
// - moving: in addition, moving linearly from start to end, they are together at some time, give or take
//   2^-45 of it. This pays where things move by more than twice their size.
enum class BoxTest { swept, both_ends, moving };

// Returns both_ends or moving, as a sample of the moving edges promises the cheaper step. Earlier calls do
// not matter.
BoxTest cheaper_box_test(const MeshData& mesh, const Motion& motion);

}  // namespace onset
