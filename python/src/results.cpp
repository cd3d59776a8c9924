// Pairs, contacts and statistics.

#include <onset/filter_counts.hpp>
#include <onset/result.hpp>
#include <string>

#include "bindings.hpp"
#include "conversion/fields.hpp"
#include "conversion/reprs.hpp"

namespace onset_python {
namespace {

void bind_pair(nb::module_& m) {
  nb::class_<onset::Pair>(m, "Pair", doc("Pair"))
      .def(
          "__init__",
          [](onset::Pair* p, onset::PairKind kind, int a, int b) {
            new (p) onset::Pair{kind, a, b, {-1, -1, -1, -1}};
          },
          nb::arg("kind"), nb::arg("a"), nb::arg("b"))
      .ONSET_FIELD(Pair, kind)
      .ONSET_FIELD(Pair, a)
      .ONSET_FIELD(Pair, b)
      .def_prop_ro(
          "vertices",
          [](const onset::Pair& p) {
            return nb::make_tuple(p.vertices[0], p.vertices[1], p.vertices[2], p.vertices[3]);
          },
          nb::sig("def vertices(self) -> tuple[int, int, int, int]"), doc("Pair.vertices"))
      .def("__eq__", [](const onset::Pair& p,
                        const onset::Pair& q) { return p.kind == q.kind && p.a == q.a && p.b == q.b; })
      .def("__eq__", [](const onset::Pair&, nb::handle) { return false; })
      .def("__hash__", [](const onset::Pair& p) { return nb::hash(nb::make_tuple(int(p.kind), p.a, p.b)); })
      .def("__repr__", [](const onset::Pair& p) { return text_of(p); });
  nb::class_<onset::PairCounts>(m, "PairCounts", "How many pairs there are of each kind.")
      .ONSET_FIELD(PairCounts, vertex_face)
      .ONSET_FIELD(PairCounts, edge_edge)
      .ONSET_FIELD(PairCounts, vertex_edge)
      .ONSET_FIELD(PairCounts, vertex_plane)
      .def("total", &onset::PairCounts::total, "All kinds together.")
      .def("__repr__", [](const onset::PairCounts& c) {
        return "PairCounts(vertex_face=" + std::to_string(c.vertex_face) +
               ", edge_edge=" + std::to_string(c.edge_edge) +
               ", vertex_edge=" + std::to_string(c.vertex_edge) +
               ", vertex_plane=" + std::to_string(c.vertex_plane) + ")";
      });
}

void bind_contact(nb::module_& m) {
  nb::class_<onset::Contact, onset::Pair>(m, "Contact", doc("Contact"))
      .ONSET_FIELD(Contact, toi)
      .ONSET_FIELD(Contact, toi_hi)
      .ONSET_FIELD(Contact, step_limit)
      .ONSET_FIELD(Contact, tolerance)
      .ONSET_FIELD(Contact, outcome)
      .ONSET_FIELD(Contact, certainty)
      .ONSET_FIELD(Contact, degenerate)
      .ONSET_FIELD(Contact, weights)
      .ONSET_FIELD(Contact, normal)
      .ONSET_FIELD(Contact, gap)
      .ONSET_FIELD(Contact, speed)
      .def("__repr__", [](const onset::Contact& c) {
        return "Contact(" + text_of(c) + ", toi=" + text_of(c.toi) +
               ", outcome=" + onset::to_string(c.outcome) + ")";
      });
}

void bind_filter_counts(nb::module_& m) {
  using namespace onset;
  nb::class_<PairFilterCounts>(m, "PairFilterCounts", doc("PairFilterCounts"))
      .ONSET_FIELD(PairFilterCounts, pairs)
      .ONSET_FIELD(PairFilterCounts, masked)
      .ONSET_FIELD(PairFilterCounts, both_static)
      .ONSET_FIELD(PairFilterCounts, same_body)
      .ONSET_FIELD(PairFilterCounts, adjacent)
      .ONSET_FIELD(PairFilterCounts, excluded)
      .ONSET_FIELD(PairFilterCounts, within_rings)
      .def("may_meet", &PairFilterCounts::may_meet, "Those that remain.");
  nb::class_<PrimitiveFilterCounts>(m, "PrimitiveFilterCounts", doc("PrimitiveFilterCounts"))
      .ONSET_FIELD(PrimitiveFilterCounts, moving)
      .ONSET_FIELD(PrimitiveFilterCounts, statics)
      .ONSET_FIELD(PrimitiveFilterCounts, dropped);
  nb::class_<FilterCounts>(m, "FilterCounts", doc("FilterCounts"))
      .ONSET_FIELD(FilterCounts, vertex_face)
      .ONSET_FIELD(FilterCounts, edge_edge)
      .ONSET_FIELD(FilterCounts, vertex_edge)
      .ONSET_FIELD(FilterCounts, vertices)
      .ONSET_FIELD(FilterCounts, edges)
      .ONSET_FIELD(FilterCounts, faces);
}

void bind_stats(nb::module_& m) {
  nb::class_<onset::Stats>(m, "Stats", doc("Stats"))
      .ONSET_FIELD(Stats, swept)
      .ONSET_FIELD(Stats, candidates)
      .ONSET_FIELD(Stats, after_culls)
      .ONSET_FIELD(Stats, inclusion)
      .ONSET_FIELD(Stats, gave_up)
      .ONSET_FIELD(Stats, contacts)
      .ONSET_FIELD(Stats, checks)
      .ONSET_FIELD(Stats, max_checks_of_a_pair)
      .ONSET_FIELD(Stats, checks_histogram)
      .ONSET_FIELD(Stats, worst)
      .ONSET_FIELD(Stats, looked_at)
      .ONSET_FIELD(Stats, seconds_broad)
      .ONSET_FIELD(Stats, seconds_narrow)
      .ONSET_FIELD(Stats, seconds_contacts)
      .ONSET_FIELD(Stats, seconds_total)
      .ONSET_FIELD(Stats, tolerance)
      .ONSET_FIELD(Stats, achieved_tolerance)
      .ONSET_FIELD(Stats, extent)
      .ONSET_FIELD(Stats, error_bound)
      .ONSET_FIELD(Stats, filter_counts)
      .ONSET_FIELD(Stats, made_static_boxes)
      .ONSET_FIELD(Stats, threads)
      .def_prop_ro("instruction_set", [](const onset::Stats& s) { return std::string(s.instruction_set); })
      .def_prop_ro("broad_phase", [](const onset::Stats& s) { return std::string(s.broad_phase); });
}

}  // namespace

void bind_results(nb::module_& m) {
  bind_pair(m);
  bind_contact(m);
  bind_filter_counts(m);
  bind_stats(m);
}

}  // namespace onset_python
