#include "src/shared/contacts.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "narrowphase/distance/contact_geometry.hpp"
#include "src/planes/plane_geometry.hpp"
#include "src/shared/find_contacts.hpp"

namespace onset {
namespace {

constexpr std::size_t kRowsALook = 1 << 15, kRowsAtOnce = 64, kRowsATask = kRowsAtOnce;

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

double earliest_toi(const std::vector<FoundPair>& found) {
  double earliest = std::numeric_limits<double>::infinity();
  for (const FoundPair& f : found) earliest = std::min(earliest, f.result.toi);
  return earliest;
}

void cut_off(std::vector<FoundPair>& found, double earliest, const Options& options, Outcome outcome,
             ActiveSet& set) {
  set.complete_until = std::numeric_limits<double>::infinity();
  set.outcome = outcome;
  if (earliest < std::numeric_limits<double>::infinity() && options.window < 1) {
    set.complete_until = earliest + options.window;
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const FoundPair& f) { return f.result.toi > set.complete_until; }),
                found.end());
  }
  if (found.size() > most_contacts(options)) {  // by one, which says until when the others are all
    const auto latest = std::max_element(found.begin(), found.end(), earlier);
    set.complete_until = latest->result.toi;
    if (set.outcome == Outcome::free) set.outcome = Outcome::out_of_memory;
    found.erase(latest);
  }
}

void fill_contacts(const Mesh& mesh, const Motion& motion, const Options& options,
                   const std::vector<FoundPair>& found, const Stop& stop, ActiveSet& set) {
  // Returns where the pairs of a kind end, which are sorted by kind.
  const auto end_of = [](PairKind kind, const auto& pairs) {
    const auto is_no_later = [&](const auto& pair) { return pair.kind <= kind; };
    return std::size_t(std::partition_point(pairs.begin(), pairs.end(), is_no_later) - pairs.begin());
  };
  const PlaneGeometries planes(mesh.data(), motion, options);
  set.contacts.reserve(found.size());
  while (set.size() < found.size() && !stop.requested()) {
    const std::size_t before = set.size();
    set.contacts.resize(std::min(before + kRowsALook, found.size()));
    parallel_ranges(set.size() - before, kRowsATask, [&](std::size_t first, std::size_t last) {
      Contact* contacts = set.contacts.data();
      first += before, last += before;
      for (std::size_t i = first; i < last; ++i) {
        static_cast<Pair&>(contacts[i]) = to_pair(mesh, found[i]);
        put(found[i].result, contacts[i]);
      }
      while (first < last) {
        const PairKind kind = found[first].kind;
        const std::size_t end = std::min({first + kRowsAtOnce, last, end_of(kind, found)});
        if (kind == PairKind::vertex_plane)
          planes.fill(contacts + first, contacts + end);
        else
          fill_geometry(motion, options.instruction_set, contacts + first, contacts + end);
        first = end;
      }
    });
  }
  const auto end = [&](PairKind kind) { return std::int64_t(end_of(kind, set.contacts)); };
  const std::int64_t faces = end(PairKind::vertex_face), edges = end(PairKind::edge_edge),
                     in_plane = end(PairKind::vertex_edge);
  set.stats.contacts = {faces, edges - faces, in_plane - edges, std::int64_t(set.size()) - in_plane};
}

}  // namespace onset
