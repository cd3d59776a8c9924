// One broad phase for a whole line search.
#include <onset/line_search.hpp>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/fields.hpp"
#include "conversion/options.hpp"
#include "conversion/reprs.hpp"
#include "conversion/signatures.hpp"

namespace onset_python {

using onset::LineSearch, onset::LineSearchStep;

void bind_line_search(nb::module_& m) {
  nb::class_<LineSearchStep, onset::StepResult>(m, "LineSearchStep", doc("LineSearchStep"))
      .ONSET_FIELD(LineSearchStep, gap_share)
      .ONSET_FIELD(LineSearchStep, gap_share_reduced)
      .ONSET_FIELD(LineSearchStep, assured)
      .ONSET_FIELD(LineSearchStep, closest)
      .def("__repr__", [](const LineSearchStep& r) {
        return "LineSearchStep(step=" + text_of(r.step) + ", outcome=" + onset::to_string(r.outcome) +
               ", limiting=" + text_of(r.limiting) + ", gap_share=" + text_of(r.gap_share) + ")";
      });
  nb::class_<LineSearch>(m, "LineSearch", doc("LineSearch"))
      .def(
          "__init__",
          [](LineSearch* search, const onset::Mesh& mesh, nb::handle x_t0, nb::handle dx,
             const nb::kwargs& named) {
            const PositionsArgument x0("x_t0", x_t0), d("dx", dx);
            const onset::LineSearchOptions options = line_search_options_of(named);
            without_lock([&, mesh] { return new (search) LineSearch(mesh, x0, d, options); });
          },
          nb::arg("mesh"), nb::arg("x_t0"), nb::arg("dx"), nb::arg("options"),
          nb::sig("def __init__(self, mesh: Mesh, x_t0: " ONSET_ARRAY_LIKE ", dx: " ONSET_ARRAY_LIKE
                  ", **options: Unpack[onset_ccd.LineSearchOptions]) -> None"),
          doc("LineSearch.LineSearch#2"))
      .def(
          "largest_step",
          [](const LineSearch& search, double upper) {
            return without_lock([&] { return search.largest_step(upper); });
          },
          nb::arg("upper") = 1.0, doc("LineSearch.largest_step"))
      .def(
          "close_pairs",
          [](const LineSearch& search, double step) {
            return without_lock([&] { return search.close_pairs(step); });
          },
          nb::arg("step"), doc("LineSearch.close_pairs"))
      .def("candidates", &LineSearch::candidates, doc("LineSearch.candidates"))
      .def("close_candidates", &LineSearch::close_candidates, doc("LineSearch.candidates"));
}

}  // namespace onset_python
