// What touches on a step, as a list and as constraints.
#include <onset/active_set.hpp>
#include <onset/constraints.hpp>
#include <onset/match.hpp>
#include <onset/vertex_map.hpp>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/calls.hpp"
#include "conversion/fields.hpp"
#include "conversion/records.hpp"
#include "conversion/signatures.hpp"

namespace onset_python {
namespace {

using onset::ActiveSet, onset::Constraints, onset::Matches, onset::Mesh;

void bind_active_set(nb::module_& m) {
  nb::class_<ActiveSet>(m, "ActiveSet", "The pairs that are not certified free on a step.")
      .ONSET_RECORDS(ActiveSet, contacts)
      .ONSET_FIELD(ActiveSet, outcome)
      .ONSET_FIELD(ActiveSet, vertex)
      .ONSET_FIELD(ActiveSet, complete_until)
      .ONSET_FIELD(ActiveSet, dimension)
      .ONSET_FIELD(ActiveSet, stats)
      .def_ro("planes", &ActiveSet::planes, doc("ActiveSet.planes"))
      .def("__len__", &ActiveSet::size)
      .def("__getitem__",
           [](const ActiveSet& set, std::ptrdiff_t row) -> onset::Contact {
             if (row < 0) row += std::ptrdiff_t(set.size());
             if (row < 0 || row >= std::ptrdiff_t(set.size()))
               throw nb::index_error("there is no such contact");
             return set[std::size_t(row)];
           })
      .def(
          "earliest",
          [](const ActiveSet& set) -> std::optional<onset::Contact> {
            const onset::Contact* first = set.earliest();
            return first != nullptr ? std::optional<onset::Contact>(*first) : std::nullopt;
          },
          doc("ActiveSet.earliest"))
      .def("__repr__", [](const ActiveSet& set) {
        return "ActiveSet(" + std::to_string(set.size()) +
               " contacts, outcome=" + onset::to_string(set.outcome) + ")";
      });
  m.def(
      "construct_active_set",
      [](const Mesh& mesh, nb::handle x_t0, nb::handle x_t1, const nb::kwargs& named) {
        return on_step(mesh, x_t0, x_t1, named,
                       [](const auto&... of) { return onset::construct_active_set(of...); });
      },
      nb::arg("mesh"), nb::arg("x_t0"), nb::arg("x_t1"), nb::arg("options"),
      ONSET_STEP_SIG("construct_active_set", "ActiveSet"), doc("construct_active_set"));
}

void bind_constraints(nb::module_& m) {
  nb::class_<Constraints>(m, "Constraints", doc("Constraints"))
      .ONSET_ARRAY(Constraints, row)
      .ONSET_ARRAY(Constraints, dof)
      .ONSET_ARRAY(Constraints, value)
      .ONSET_ARRAY(Constraints, bound)
      .def("rows", &Constraints::rows, "The number of rows.");
  m.def(
      "assemble_constraints",
      [](const ActiveSet& set, double eta, const onset::VertexMap& map) {
        return without_lock([&] { return onset::assemble_constraints(set, eta, map); });
      },
      nb::arg("set"), nb::arg("eta"), nb::arg("map"), doc("assemble_constraints#2"));
  m.def(
      "assemble_constraints",
      [](const ActiveSet& set, double eta, nb::handle full_vertex) {
        const std::vector<int> full = ids("full_vertex", full_vertex);
        return without_lock([&] { return onset::assemble_constraints(set, eta, full); });
      },
      nb::arg("set"), nb::arg("eta") = 0.0, nb::arg("full_vertex") = nb::none(),
      nb::sig("def assemble_constraints(set: ActiveSet, eta: float = 0.0, full_vertex: " ONSET_ARRAY_LIKE
              " | None = None) -> Constraints"),
      doc("assemble_constraints"));
}

template <class List>
void bind_match_of(nb::module_& m, const char* signature) {
  m.def(
      "match",
      [](const List& from, const List& to) { return without_lock([&] { return onset::match(from, to); }); },
      nb::arg("from_"), nb::arg("to"), nb::sig(signature), doc("match"));
}

void bind_match(nb::module_& m) {
  nb::class_<Matches>(m, "Matches", "Which rows of two lists are the same pair.")
      .ONSET_ARRAY(Matches, to_of_from)
      .ONSET_ARRAY(Matches, from_of_to)
      .ONSET_FIELD(Matches, count);
  bind_match_of<ActiveSet>(m, "def match(from_: ActiveSet, to: ActiveSet) -> Matches");
  bind_match_of<onset::ClosePairs>(m, "def match(from_: ClosePairs, to: ClosePairs) -> Matches");
  m.def(
      "match",
      [](nb::handle from, nb::handle to) {
        const std::vector<onset::Pair> a = pairs_of("from_", from), b = pairs_of("to", to);
        return without_lock([&] { return onset::match(a, b); });
      },
      nb::arg("from_"), nb::arg("to"),
      nb::sig("def match(from_: numpy.typing.NDArray | Iterable[Pair], to: numpy.typing.NDArray | "
              "Iterable[Pair]) -> Matches"),
      doc("match#2"));
}

}  // namespace

void bind_active_sets(nb::module_& m) {
  bind_active_set(m);
  bind_constraints(m);
  bind_match(m);
}

}  // namespace onset_python
