// Pairs within d_hat, and the bounds that follow from them.
#include <onset/close_pairs.hpp>
#include <onset/safe_distance.hpp>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/fields.hpp"
#include "conversion/options.hpp"
#include "conversion/records.hpp"
#include "conversion/signatures.hpp"

namespace onset_python {

using onset::ClosePairs, onset::Mesh;

void bind_close_pairs(nb::module_& m) {
  nb::class_<ClosePairs>(m, "ClosePairs", "The pairs within d_hat of each other at one time.")
      .ONSET_RECORDS(ClosePairs, pairs)
      .ONSET_FIELD(ClosePairs, d_hat)
      .ONSET_FIELD(ClosePairs, outcome)
      .ONSET_FIELD(ClosePairs, vertex)
      .def_ro("seconds", &ClosePairs::seconds)
      .def("__len__", &ClosePairs::size);
  m.def(
      "close_pairs",
      [](const Mesh& mesh, nb::handle x, double d_hat, const nb::kwargs& named) {
        const PositionsArgument positions("x", x);
        const onset::Options options = options_of(named);
        return without_lock([&, mesh] { return onset::close_pairs(mesh, positions, d_hat, options); });
      },
      nb::arg("mesh"), nb::arg("x"), nb::arg("d_hat"), nb::arg("options"),
      nb::sig("def close_pairs(mesh: Mesh, x: " ONSET_ARRAY_LIKE ", d_hat: float, " ONSET_OPTIONS
              ") -> ClosePairs"),
      doc("close_pairs"));
  m.def(
      "safe_distances",
      [](const Mesh& mesh, nb::handle x, const ClosePairs& close) {
        const PositionsArgument positions("x", x);
        return taken_array(without_lock([&, mesh] { return onset::safe_distances(mesh, positions, close); }));
      },
      nb::arg("mesh"), nb::arg("x"), nb::arg("close"),
      nb::sig("def safe_distances(mesh: Mesh, x: " ONSET_ARRAY_LIKE
              ", close: ClosePairs) -> numpy.typing.NDArray[numpy.float64]"),
      doc("safe_distances"));
  m.def(
      "safe_step",
      [](nb::handle r, nb::handle dx) {
        const std::vector<double> distances = doubles("r", r);
        const PositionsArgument displacements("dx", dx);
        return without_lock([&] { return onset::safe_step(distances, displacements); });
      },
      nb::arg("r"), nb::arg("dx"),
      nb::sig("def safe_step(r: " ONSET_ARRAY_LIKE ", dx: " ONSET_ARRAY_LIKE ") -> float"), doc("safe_step"));
}

}  // namespace onset_python
