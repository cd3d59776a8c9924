// What makes a pair a candidate.
#pragma once

namespace onset {

struct MeshData;
struct Motion;

// What a candidate is. swept: the boxes of the motion, exact in double, each widened outward, overlap (closed
// boxes). both_ends: in addition no axis separates the boxes on the same side at both ends of the step, since
// then linear motion keeps them apart throughout; a subset of swept up to outward rounding. moving: in
// addition the boxes, each moving linearly from its place at the start to that at the end, are together at
// some time, give or take 2^-45 of it; a subset of both_ends, and worth its cost where things move by more than
// twice their size.
enum class BoxTest { swept, both_ends, moving };

// Both ends or moving: which of them makes a step cheaper. Follows from a sample of the moving edges, whatever
// was asked of the mesh before.
BoxTest cheaper_box_test(const MeshData& mesh, const Motion& motion);

}  // namespace onset
