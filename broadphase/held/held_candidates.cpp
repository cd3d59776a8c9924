#include "broadphase/held/held_candidates.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "base/simd/rows.hpp"
#include "broadphase/bvh/box_tree.hpp"
#include "broadphase/motion_box.hpp"
#include "scene/motion/static_motion.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr std::size_t kBlocksAChunk = 16;

// All vertices, but for the static ones where static_part says that they are where they were. It is null
// where no static primitive takes part; static vertices of others may then be elsewhere in the next call.
const std::vector<int>* listed(const BroadPhaseInput& input) {
  const std::vector<int>& free_ids = input.mesh.filter->free_ids;
  return input.motion.static_part && !free_ids.empty() ? &free_ids : nullptr;
}
std::size_t count_rows(const BroadPhaseInput& input) {
  const std::vector<int>* ids = listed(input);
  return ids ? ids->size() : std::size_t(input.mesh.num_vertices);
}
const double* row(const BroadPhaseInput& input, const std::vector<int>* ids, std::size_t i) {
  return input.motion.t0(ids ? (*ids)[i] : int(i));
}

// The largest change of a coordinate, and the largest magnitude of the new one.
struct Change {
  double moved = 0, magnitude = 0;
};
Change larger(const Change& a, const Change& b) {
  return {std::max(a.moved, b.moved), std::max(a.magnitude, b.magnitude)};
}
double largest_lane(const D4& x) {
  double lanes[4];
  x.store(lanes);
  return *std::max_element(lanes, lanes + 4);
}

const int* vertices_of(const MeshData& mesh, Primitive kind) {
  if (kind == Primitive::edge) return mesh.edges.empty() ? nullptr : mesh.edges.front().data();
  if (kind == Primitive::face) return mesh.faces.empty() ? nullptr : mesh.faces.front().data();
  return nullptr;
}

void test_pairs(const HeldArguments& arguments, InstructionSet instruction_set) {
#ifdef ONSET_HAVE_AVX2
  if (runs_avx2(resolve_instruction_set(instruction_set))) return held_avx2::test_pairs(arguments);
#endif
  (void)instruction_set;
  held_scalar::test_pairs(arguments);
}

}  // namespace

HeldPositions::HeldPositions(const BroadPhaseInput& input)
    : axes(input.motion.axes),
      rows(count_rows(input) * kMotionStride),
      static_part(input.motion.static_part) {
  const std::vector<int>* ids = listed(input);
  const Change all = parallel_reduce(
      rows.size() / kMotionStride, kGrain, Change{},
      [&](std::size_t first, std::size_t last) {
        D4 most = D4::all(0);
        for (std::size_t i = first; i < last; ++i) {
          const double* x = row(input, ids, i);
          const D4 t0 = D4::load(x), t1 = D4::load(x + 4);
          t0.store(rows.data() + i * kMotionStride), t1.store(rows.data() + i * kMotionStride + 4);
          most = max(abs(t1), max(abs(t0), most));
        }
        return Change{0, largest_lane(most)};
      },
      larger);
  largest = all.magnitude;
}

double HeldPositions::moved(const BroadPhaseInput& input, double& magnitude) const {
  magnitude = INFINITY;
  if (axes != input.motion.axes || rows.size() != count_rows(input) * kMotionStride ||
      static_part != input.motion.static_part)
    return INFINITY;
  const std::vector<int>* ids = listed(input);
  const Change all = parallel_reduce(
      rows.size() / kMotionStride, kGrain, Change{},
      [&](std::size_t first, std::size_t last) {
        D4 most = D4::all(0), change = most;
        for (std::size_t i = first; i < last; ++i) {
          const double *x = row(input, ids, i), *then = rows.data() + i * kMotionStride;
          const D4 t0 = D4::load(x), t1 = D4::load(x + 4);
          change = max(abs(t1 - D4::load(then + 4)), max(abs(t0 - D4::load(then)), change));
          most = max(abs(t1), max(abs(t0), most));
        }
        return Change{largest_lane(change), largest_lane(most)};
      },
      larger);
  magnitude = std::max(largest, all.magnitude);
  for (std::size_t a = 0; static_part && a < 3; ++a)
    magnitude = std::max({magnitude, std::fabs(static_part->lo[a]), std::fabs(static_part->hi[a])});
  return all.moved * (1 + 0x1p-50);  // differences were rounded
}

double HeldCandidates::least_slack(const BroadPhaseInput& input, double magnitude) {
  return 0x1p-38 * (magnitude + input.inflation + input.diagonals.margin) + 0x1p-1000;
}

// Let L bound all coordinates, then and now, and the inflation of then. What is asked here makes every box of
// now, but of what is static and unchanged, lie within the same one of then by d = 2^-41 L on each side at
// both ends: all roundings of both are below 2^-49 L. So every reach of a box over another has fallen by d:
// a pair that was apart along a side at both ends is so still, on a part of the step too, and one whose
// moving boxes were apart has a begin that is later and an end that is earlier, each by a factor of 2^-43,
// while computed roots err by a few 2^-53 (docs/theory.md, L50). What is asked of the margin does the same
// for diagonals (L54).
bool HeldCandidates::cover(const BroadPhaseInput& input, double moved, double magnitude) const {
  if (!held_ || input.test == BoxTest::swept || size_ >= input.most_held) return false;
  if (test_ == BoxTest::moving && (input.test != BoxTest::moving || input.t_max != 1)) return false;
  if (input.mesh.filter->has_static() && part_inflation(input, true) != static_inflation_) return false;
  const double allowance = 0x1p-40 * (magnitude + inflation_ + tested_by_.margin) + 0x1p-1000;
  if (tested_by_.used) {
    const DiagonalTest& now = input.diagonals;
    if (!now.used || now.norm != tested_by_.norm || input.t_max != 1) return false;
    if (!((now.margin + moved + allowance) * (1 + 0x1p-50) <= tested_by_.margin)) return false;
  }
  return (part_inflation(input, false) + moved + allowance) * (1 + 0x1p-50) <= inflation_;
}

bool HeldCandidates::fill(const BroadPhase& tree, const BroadPhaseInput& input, PairKind kind,
                          std::size_t most, const Stop& stop, List& list) {
  const MeshData& mesh = input.mesh;
  const bool has_static = mesh.filter->has_static();
  const std::size_t blocks = tree.blocks(kind), chunks = (blocks + kBlocksAChunk - 1) / kBlocksAChunk;
  list.ends.assign(blocks, 0), list.is_static.assign(blocks, {});
  std::vector<std::vector<IdPair>> found(chunks);
  struct Filling {
    const Stop& stop;
    std::atomic<std::size_t> room;
    static bool asked(void* context) {
      const auto& f = *static_cast<const Filling*>(context);
      return f.stop.requested() || f.room.load(std::memory_order_relaxed) == 0;
    }
  } filling{stop, {most}};
  struct Found {
    Filling& filling;
    std::vector<IdPair>& pairs;
    static void append(void* context, const IdPair* pairs, std::size_t count) {
      Found& found = *static_cast<Found*>(context);
      std::size_t room = found.filling.room.load(std::memory_order_relaxed);
      while (!found.filling.room.compare_exchange_weak(room, room - std::min(room, count))) {
      }
      if (room > count) found.pairs.insert(found.pairs.end(), pairs, pairs + count);
    }
  };
  const auto classify = [&](std::size_t block, IdPair* first, IdPair* last) {
    if (first == last) return;
    const Primitive a = first_primitive(kind), b = second_primitive(kind);
    if (kind == PairKind::edge_edge)
      for (IdPair* p = first; p != last; ++p)
        if (is_static(mesh, a, p->a)) std::swap(p->a, p->b);
    list.is_static[block] = {is_static(mesh, a, first->a), is_static(mesh, b, first->b)};
  };
  parallel_ranges(chunks, 1, [&](std::size_t chunk, std::size_t end) {
    for (; chunk < end; ++chunk) {
      std::vector<IdPair>& mine = found[chunk];
      const std::size_t last = std::min(blocks, (chunk + 1) * kBlocksAChunk);
      for (std::size_t block = chunk * kBlocksAChunk; block < last && !Filling::asked(&filling); ++block) {
        const std::size_t before = mine.size();
        Found to{filling, mine};
        tree.traverse(kind, block, block + 1, {&to, &Found::append, {&filling, &Filling::asked}});
        if (has_static) classify(block, mine.data() + before, mine.data() + mine.size());
        list.ends[block] = mine.size() - before;
      }
    }
  });
  const bool filled = !Filling::asked(&filling);
  if (filled) {
    std::partial_sum(list.ends.begin(), list.ends.end(), list.ends.begin());
    list.pairs = AlignedArray<IdPair>(blocks == 0 ? 0 : list.ends.back());
  }
  // What was found is given back in parallel, whatever becomes of it: that takes its time.
  parallel_ranges(chunks, 4, [&](std::size_t chunk, std::size_t end) {
    for (; chunk < end; ++chunk) {
      const std::size_t at = chunk == 0 || !filled ? 0 : list.ends[chunk * kBlocksAChunk - 1];
      if (filled && !stop.requested())
        std::copy(found[chunk].begin(), found[chunk].end(), list.pairs.data() + at);
      found[chunk] = {};
    }
  });
  return filled && !stop.requested();
}

// Of few pairs few vertices need a record; else all that take part have one.
void HeldCandidates::list_vertices(const BroadPhaseInput& input) {
  const MeshData& mesh = input.mesh;
  const PrimitiveFilter& filter = *mesh.filter;
  if (4 * size_ >= std::size_t(mesh.num_vertices)) {
    vertices_ = {filter.moving_vertices, filter.static_vertices};
    if (filter.all) {
      vertices_[0].resize(std::size_t(mesh.num_vertices));
      std::iota(vertices_[0].begin(), vertices_[0].end(), 0);
    }
    return;
  }
  std::array<std::vector<char>, 2> used;
  for (auto& u : used) u.resize(std::size_t(mesh.num_vertices));
  const auto note = [&](bool still, Primitive kind, int id) {
    for (const int v : primitive_vertices(mesh, kind, id)) used[std::size_t(still)][std::size_t(v)] = 1;
  };
  for (const PairKind kind : kStepKinds) {
    const List& list = lists_[std::size_t(kind)];
    std::size_t i = 0;
    for (std::size_t block = 0; block < list.ends.size(); ++block)
      for (; i < list.ends[block]; ++i) {
        note(list.is_static[block][0], first_primitive(kind), list.pairs[i].a);
        note(list.is_static[block][1], second_primitive(kind), list.pairs[i].b);
      }
  }
  for (std::size_t c = 0; c < 2; ++c) {
    vertices_[c].clear();
    for (int v = 0; v < mesh.num_vertices; ++v)
      if (used[c][std::size_t(v)] != 0) vertices_[c].push_back(v);
  }
}

bool HeldCandidates::take(const BroadPhase& tree, const BroadPhaseInput& input, std::size_t most,
                          const Stop& stop) {
  clear();
  for (const PairKind kind : wanted_kinds(input)) {
    List& list = lists_[std::size_t(kind)];
    if (!fill(tree, input, kind, most - size_, stop, list)) {
      clear();
      return false;
    }
    size_ += list.pairs.size();
    if (size_ >= most) {
      clear();
      return false;
    }
  }
  test_ = input.test;
  inflation_ = part_inflation(input, false), static_inflation_ = part_inflation(input, true);
  tested_by_ = input.diagonals;
  list_vertices(input);
  map_.emplace(input.motion);
  held_ = true;
  return true;
}

void HeldCandidates::clear() {
  held_ = false;
  size_ = 0;
  for (List& list : lists_) list = List();
  for (auto& v : vertices_) v = {};
  for (auto& r : records_) r = AlignedArray<float>();
  for (auto& d : diagonals_) d = DiagonalRecords();
}

void HeldCandidates::fit(const BroadPhaseInput& input, double magnitude, const Stop& stop) {
  input_.emplace(input);
  input_->instruction_set = resolve_instruction_set(input.instruction_set);
  const FloatMap& map = *map_;
  constexpr std::size_t kStride = std::size_t(kBoxStrideOf[1]);
  rounded_axes_ = 0;
  for (std::size_t c = 0; c < 2; ++c) {
    if (vertices_[c].empty()) continue;
    const std::size_t size = std::size_t(input.mesh.num_vertices) * kStride;
    if (records_[c].size() < size) records_[c] = AlignedArray<float>(size);
    rounded_axes_ |=
        write_supports(*input_, part_inflation(input, c == 1), map, Primitive::vertex, vertices_[c].data(),
                       vertices_[c].size(), {records_[c].data(), kStride, true}, stop);
    if (input.diagonals.used)
      diagonals_[c].write(*input_, input.t_max, map.linear_part(), vertices_[c].data(), vertices_[c].size(),
                          std::size_t(input.mesh.num_vertices), true, stop);
  }
  linear_ = input.test == BoxTest::moving && map.is_linear() && map.keeps(magnitude + 2 * inflation_);
}

std::size_t HeldCandidates::blocks(PairKind kind) const { return lists_[std::size_t(kind)].ends.size(); }

void HeldCandidates::traverse(PairKind kind, std::size_t first, std::size_t last,
                              const PairSink& sink) const {
  const List& list = lists_[std::size_t(kind)];
  ONSET_ASSERT(last <= list.ends.size());
  const FreeList<TraversalMemory>::Loan memory(memory_);
  const OverlapDecision decide{*input_, kind};
  HeldArguments a{};
  a.first_vertices = vertices_of(input_->mesh, first_primitive(kind));
  a.second_vertices = vertices_of(input_->mesh, second_primitive(kind));
  a.sides = sides_of(kind), a.test = input_->test;
  a.rounded_axes = rounded_axes_, a.linear = linear_;
  a.meets = OverlapDecision::meet, a.diagonals_apart = OverlapDecision::diagonals_apart, a.context = &decide;
  a.consume = sink.consume, a.consume_context = sink.context;
  a.stop = sink.stop.asked, a.stop_context = sink.stop.context;
  a.memory = &*memory;
  for (std::size_t end; first < last; first = end) {
    const std::array<bool, 2>& alike = list.is_static[first];
    for (end = first + 1; end < last && list.is_static[end] == alike; ++end) {
    }
    const std::size_t begin = first == 0 ? 0 : list.ends[first - 1];
    a.pairs = list.pairs.data() + begin, a.count = list.ends[end - 1] - begin;
    a.first_records = records_[std::size_t(alike[0])].data();
    a.second_records = records_[std::size_t(alike[1])].data();
    DiagonalLimits limits;
    if (input_->diagonals.used) {
      const DiagonalRecords &p = diagonals_[std::size_t(alike[0])], &q = diagonals_[std::size_t(alike[1])];
      const double inflations = part_inflation(*input_, alike[0]) + part_inflation(*input_, alike[1]);
      limits = diagonal_limits(*input_, inflations, p, q);
      a.diagonals = &limits;
      a.first_diagonals = p.records.data(), a.second_diagonals = q.records.data();
    }
    if (a.count > 0) test_pairs(a, input_->instruction_set);
  }
}

}  // namespace onset
