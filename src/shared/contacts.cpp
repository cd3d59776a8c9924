#include "src/shared/contacts.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "narrowphase/distance/contact_geometry.hpp"

namespace onset {
namespace {

constexpr std::size_t kRowsATask = 512, kRowsAtOnce = 64;

// Adds the geometry of contacts [first, last), which are of one kind and at most kRowsAtOnce.
void fill_geometry(const Motion& motion, InstructionSet instruction_set, Contact* first, Contact* last) {
  ContactGeometry geometry[kRowsAtOnce];
  std::array<int, 4> vertices[kRowsAtOnce];
  double toi[kRowsAtOnce];
  bool parting[kRowsAtOnce] = {};
  const std::size_t count = std::size_t(last - first);
  for (std::size_t i = 0; i < count; ++i) {
    vertices[i] = first[i].vertices, toi[i] = first[i].toi;
    parting[i] = first[i].outcome == PairOutcome::initial_separating;
  }
  contact_geometries(instruction_set, first->kind, motion, vertices, toi, parting, count, geometry);
  for (std::size_t i = 0; i < count; ++i) put(geometry[i], first[i]);
}

}  // namespace

void put(const PairResult& result, Contact& contact) {
  contact.toi = result.toi, contact.toi_hi = result.toi_hi, contact.step_limit = result.step_limit;
  contact.tolerance = result.tolerance, contact.outcome = result.outcome,
  contact.certainty = result.certainty;
}

void put(const ContactGeometry& geometry, Contact& contact) {
  contact.weights = geometry.weights, contact.normal = geometry.normal;
  contact.gap = geometry.gap, contact.speed = geometry.speed, contact.degenerate = geometry.degenerate;
}

void fill_contacts(const Mesh& mesh, const Motion& motion, InstructionSet instruction_set,
                   const std::vector<FoundPair>& found, ActiveSet& set) {
  const auto of_faces = std::partition_point(
      found.begin(), found.end(), [](const FoundPair& f) { return f.kind == PairKind::vertex_face; });
  const auto faces = std::size_t(of_faces - found.begin());
  set.stats.contacts = {std::int64_t(faces), std::int64_t(found.size() - faces)};
  set.contacts.resize(found.size());
  parallel_ranges(found.size(), kRowsATask, [&](std::size_t first, std::size_t last) {
    Contact* contacts = set.contacts.data();
    for (std::size_t i = first; i < last; ++i) {
      static_cast<Pair&>(contacts[i]) = to_pair(mesh, found[i]);
      put(found[i].result, contacts[i]);
    }
    while (first < last) {
      const std::size_t end = std::min({first + kRowsAtOnce, last, first < faces ? faces : last});
      fill_geometry(motion, instruction_set, contacts + first, contacts + end);
      first = end;
    }
  });
}

}  // namespace onset
