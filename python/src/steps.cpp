// How far a step can go.
#include <onset/safe_distance.hpp>
#include <onset/step_size.hpp>
#include <onset/truncate_step.hpp>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/calls.hpp"
#include "conversion/fields.hpp"
#include "conversion/records.hpp"
#include "conversion/reprs.hpp"
#include "conversion/signatures.hpp"

namespace onset_python {
namespace {

using onset::Mesh, onset::StepResult, onset::TruncatedStep;

void bind_step_result(nb::module_& m) {
  nb::class_<StepResult>(m, "StepResult", "How far a step can go, and what limits it.")
      .ONSET_FIELD(StepResult, step)
      .ONSET_FIELD(StepResult, shortest)
      .ONSET_FIELD(StepResult, toi)
      .ONSET_FIELD(StepResult, toi_hi)
      .ONSET_FIELD(StepResult, rounding)
      .ONSET_FIELD(StepResult, outcome)
      .ONSET_FIELD(StepResult, certainty)
      .ONSET_FIELD(StepResult, limiting)
      .ONSET_FIELD(StepResult, vertex)
      .ONSET_FIELD(StepResult, stats)
      .def("__repr__", [](const StepResult& r) {
        return "StepResult(step=" + text_of(r.step) + ", outcome=" + onset::to_string(r.outcome) +
               ", toi=" + text_of(r.toi) + ", limiting=" + text_of(r.limiting) + ")";
      });
}

StepResult step(const Mesh& mesh, nb::handle x_t0, nb::handle x_t1, const nb::kwargs& named) {
  return on_step(mesh, x_t0, x_t1, named,
                 [](const auto&... of) { return onset::compute_collision_free_stepsize(of...); });
}

StepResult step_of_candidates(const Mesh& mesh, const onset::Candidates& candidates, nb::handle x_t0,
                              nb::handle x_t1, double gap_share, const nb::kwargs& named) {
  return on_step(mesh, x_t0, x_t1, named, [&](const Mesh& copy, const auto&... of) {
    return onset::compute_collision_free_stepsize(copy, candidates, of..., gap_share);
  });
}

StepResult cfl_step(const Mesh& mesh, nb::handle x_t0, nb::handle x_t1, const onset::ClosePairs& close,
                    double gap_share, const nb::kwargs& named) {
  return on_step(mesh, x_t0, x_t1, named,
                 [&](const Mesh& copy, const onset::Positions& x0, const onset::Positions& x1,
                     const onset::Options& options) {
                   return onset::compute_cfl_stepsize(copy, x0, x1, close, options, gap_share);
                 });
}

// #V x dimension, of what the result holds.
nb::object rows_of(nb::handle self, const std::vector<double> TruncatedStep::*member) {
  const auto& r = nb::cast<const TruncatedStep&>(self);
  const std::size_t vertices = r.share.size();
  return array_of((r.*member).data(), {vertices, vertices == 0 ? 3 : (r.*member).size() / vertices}, self);
}

void bind_truncated(nb::module_& m) {
  nb::class_<TruncatedStep>(m, "TruncatedStep", "A step for each vertex.")
      .def_prop_ro(
          "positions", [](nb::handle self) { return rows_of(self, &TruncatedStep::positions); },
          nb::sig("def positions(self) -> numpy.typing.NDArray[numpy.float64]"),
          doc("TruncatedStep.positions"))
      .def_prop_ro(
          "displacements", [](nb::handle self) { return rows_of(self, &TruncatedStep::displacements); },
          nb::sig("def displacements(self) -> numpy.typing.NDArray[numpy.float64]"),
          doc("TruncatedStep.displacements"))
      .ONSET_ARRAY(TruncatedStep, share)
      .def_ro("kept", &TruncatedStep::kept, doc("TruncatedStep.share"))
      .ONSET_RECORDS(TruncatedStep, pairs)
      .ONSET_ARRAY(TruncatedStep, limited_by)
      .ONSET_FIELD(TruncatedStep, outcome)
      .ONSET_FIELD(TruncatedStep, limiting)
      .ONSET_FIELD(TruncatedStep, vertex)
      .ONSET_FIELD(TruncatedStep, stats)
      .def("__repr__", [](const TruncatedStep& r) {
        return "TruncatedStep(kept=" + text_of(r.kept) + ", outcome=" + onset::to_string(r.outcome) +
               ", limiting=" + text_of(r.limiting) + ")";
      });
  m.def(
      "truncate_step",
      [](const Mesh& mesh, nb::handle x_t0, nb::handle x_t1, const nb::kwargs& named) {
        return on_step(
            mesh, x_t0, x_t1, named, [](const auto&... of) { return onset::truncate_step(of...); },
            &truncate_options_of);
      },
      nb::arg("mesh"), nb::arg("x_t0"), nb::arg("x_t1"), nb::arg("options"),
      nb::sig("def truncate_step(" ONSET_MOTION
              ", **options: Unpack[onset_ccd.TruncateOptions]) -> TruncatedStep"),
      doc("truncate_step"));
}

}  // namespace

void bind_steps(nb::module_& m) {
  bind_step_result(m);
  m.def("compute_collision_free_stepsize", &step, nb::arg("mesh"), nb::arg("x_t0"), nb::arg("x_t1"),
        nb::arg("options"), ONSET_STEP_SIG("compute_collision_free_stepsize", "StepResult"),
        doc("compute_collision_free_stepsize"));
  m.def("compute_collision_free_stepsize", &step_of_candidates, nb::arg("mesh"), nb::arg("candidates"),
        nb::arg("x_t0"), nb::arg("x_t1"), nb::arg("gap_share") = 0.0, nb::arg("options"),
        nb::sig(
            "def compute_collision_free_stepsize(mesh: Mesh, candidates: Candidates, x_t0: " ONSET_ARRAY_LIKE
            ", x_t1: " ONSET_ARRAY_LIKE ", gap_share: float = 0.0, " ONSET_OPTIONS ") -> StepResult"),
        doc("compute_collision_free_stepsize#2"));
  m.def(
      "is_step_collision_free",
      [](const Mesh& mesh, nb::handle x_t0, nb::handle x_t1, const nb::kwargs& named) {
        return on_step(mesh, x_t0, x_t1, named,
                       [](const auto&... of) { return onset::is_step_collision_free(of...); });
      },
      nb::arg("mesh"), nb::arg("x_t0"), nb::arg("x_t1"), nb::arg("options"),
      ONSET_STEP_SIG("is_step_collision_free", "bool"), doc("is_step_collision_free"));
  m.def("compute_cfl_stepsize", &cfl_step, nb::arg("mesh"), nb::arg("x_t0"), nb::arg("x_t1"),
        nb::arg("close"), nb::arg("gap_share") = 0.2, nb::arg("options"),
        nb::sig("def compute_cfl_stepsize(" ONSET_MOTION
                ", close: ClosePairs, gap_share: float = 0.2, " ONSET_OPTIONS ") -> StepResult"),
        doc("compute_cfl_stepsize"));
  bind_truncated(m);
}

}  // namespace onset_python
