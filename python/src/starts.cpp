// Whether positions will do as a start.
#include <onset/check.hpp>
#include <onset/intersections.hpp>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/fields.hpp"
#include "conversion/options.hpp"
#include "conversion/records.hpp"
#include "conversion/signatures.hpp"

namespace onset_python {
namespace {

using onset::Intersections, onset::Mesh, onset::StartFinding, onset::StartReport;

template <class Call>
auto ask(const Mesh& mesh, nb::handle x, const nb::kwargs& named, const Call& call) {
  const PositionsArgument positions("x", x);
  const onset::Options options = options_of(named);
  return without_lock([&, mesh] { return call(mesh, positions, options); });
}

#define ONSET_START_SIG(name, result) \
  nb::sig("def " name "(mesh: Mesh, x: " ONSET_ARRAY_LIKE ", " ONSET_OPTIONS ") -> " result)

void bind_intersections(nb::module_& m) {
  nb::class_<Intersections>(m, "Intersections", "The edges and faces with a common point.")
      .ONSET_RECORDS(Intersections, pairs)
      .ONSET_ARRAY(Intersections, behind_planes)
      .ONSET_FIELD(Intersections, outcome)
      .ONSET_FIELD(Intersections, vertex)
      .def_ro("seconds", &Intersections::seconds)
      .def("empty", &Intersections::empty, doc("Intersections.empty"))
      .def("count", &Intersections::count, nb::arg("kind"), doc("Intersections.count"))
      .def("__len__", &Intersections::size);
  m.def(
      "intersections",
      [](const Mesh& mesh, nb::handle x, const nb::kwargs& named) {
        return ask(mesh, x, named, onset::intersections);
      },
      nb::arg("mesh"), nb::arg("x"), nb::arg("options"), ONSET_START_SIG("intersections", "Intersections"),
      doc("intersections"));
  m.def(
      "has_intersections",
      [](const Mesh& mesh, nb::handle x, const nb::kwargs& named) {
        return ask(mesh, x, named, onset::has_intersections);
      },
      nb::arg("mesh"), nb::arg("x"), nb::arg("options"), ONSET_START_SIG("has_intersections", "bool"),
      doc("has_intersections"));
}

void bind_check(nb::module_& m) {
  nb::class_<StartFinding>(m, "StartFinding", doc("StartFinding"))
      .def_ro("fault", &StartFinding::fault)
      .def_ro("count", &StartFinding::count)
      .ONSET_FIELD(StartFinding, text)
      .def("__repr__", [](const StartFinding& f) { return f.text; });
  nb::class_<StartReport>(m, "StartReport", doc("StartReport"))
      .ONSET_RECORDS(StartReport, intersections)
      .ONSET_RECORDS(StartReport, touching)
      .ONSET_RECORDS(StartReport, within_separation)
      .ONSET_ARRAY(StartReport, copied_vertices)
      .ONSET_ARRAY(StartReport, faces_without_area)
      .ONSET_ARRAY(StartReport, unused_vertices)
      .ONSET_FIELD(StartReport, findings)
      .ONSET_FIELD(StartReport, outcome)
      .ONSET_FIELD(StartReport, vertex)
      .def_ro("seconds", &StartReport::seconds)
      .def("acceptable", &StartReport::acceptable, doc("StartReport.acceptable"))
      .def("clean", &StartReport::clean, doc("StartReport.clean"));
  m.def(
      "check",
      [](const Mesh& mesh, nb::handle x, const nb::kwargs& named) {
        return ask(mesh, x, named, onset::check);
      },
      nb::arg("mesh"), nb::arg("x"), nb::arg("options"), ONSET_START_SIG("check", "StartReport"),
      doc("check"));
}

}  // namespace

void bind_starts(nb::module_& m) {
  bind_intersections(m);
  bind_check(m);
  m.def(
      "duplicate_vertices",
      [](nb::handle x) {
        const PositionsArgument positions("x", x);
        return taken_array(without_lock([&] { return onset::duplicate_vertices(positions); }));
      },
      nb::arg("x"),
      nb::sig("def duplicate_vertices(x: " ONSET_ARRAY_LIKE ") -> numpy.typing.NDArray[numpy.int32]"),
      doc("duplicate_vertices"));
}

}  // namespace onset_python
