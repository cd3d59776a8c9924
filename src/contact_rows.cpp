#include "src/contact_rows.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "narrowphase/distance/contact_geometry.hpp"

namespace onset {
namespace {

constexpr std::size_t kRowsATask = 512, kRowsAtOnce = 64;

void resize(ActiveSet& set, std::size_t rows) {
  set.kind.resize(rows), set.a.resize(rows), set.b.resize(rows), set.vertices.resize(rows);
  set.toi.resize(rows), set.step_limit.resize(rows), set.status.resize(rows), set.certainty.resize(rows);
  set.toi_hi.resize(rows), set.weight.resize(rows), set.normal.resize(rows), set.gap.resize(rows);
  set.speed.resize(rows), set.degenerate.resize(rows);
}

void fill_row(const Mesh& mesh, const FoundPair& f, std::size_t i, ActiveSet& set) {
  const Pair pair = to_pair(mesh, f);
  set.kind[i] = pair.kind, set.a[i] = pair.a, set.b[i] = pair.b, set.vertices[i] = pair.vertices;
  set.toi[i] = f.result.toi, set.step_limit[i] = f.result.step_limit, set.toi_hi[i] = f.result.toi_hi;
  set.status[i] = f.result.outcome, set.certainty[i] = f.result.certainty;
}

// Rows [first, last) are of one kind, and at most kRowsAtOnce.
void fill_frames(const Motion& motion, InstructionSet kernel, std::size_t first, std::size_t last, ActiveSet& set) {
  ContactGeometry frames[kRowsAtOnce];
  bool parting[kRowsAtOnce] = {};
  for (std::size_t i = first; i < last; ++i)
    parting[i - first] = set.status[i] == Outcome::initial_separating;
  contact_geometries(kernel, set.kind[first], motion, set.vertices.data() + first, set.toi.data() + first,
                 parting, last - first, frames);
  for (std::size_t i = first; i < last; ++i) {
    const ContactGeometry& f = frames[i - first];
    set.weight[i] = f.weight, set.normal[i] = f.normal, set.gap[i] = f.gap, set.speed[i] = f.speed;
    set.degenerate[i] = f.degenerate;
  }
}

}  // namespace

void fill_rows(const Mesh& mesh, const Motion& motion, InstructionSet kernel, const std::vector<FoundPair>& found,
               ActiveSet& set) {
  const auto of_faces = std::partition_point(
      found.begin(), found.end(), [](const FoundPair& f) { return f.kind == PairKind::vertex_face; });
  const auto faces = std::size_t(of_faces - found.begin());
  set.stats.contacts = {std::int64_t(faces), std::int64_t(found.size() - faces)};
  resize(set, found.size());
  parallel_ranges(found.size(), kRowsATask, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) fill_row(mesh, found[i], i, set);
    while (first < last) {
      const std::size_t end = std::min({first + kRowsAtOnce, last, first < faces ? faces : last});
      fill_frames(motion, kernel, first, end, set);
      first = end;
    }
  });
}

}  // namespace onset
