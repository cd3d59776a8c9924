// The broad phase alone.
#include <onset/candidates.hpp>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/callbacks.hpp"
#include "conversion/calls.hpp"
#include "conversion/fields.hpp"
#include "conversion/signatures.hpp"

namespace onset_python {
namespace {

using onset::Candidates, onset::Mesh;

void bind_list(nb::module_& m) {
  nb::class_<Candidates>(m, "Candidates", doc("Candidates"))
      .def(
          "__init__",
          [](Candidates* c, nb::handle vertex_face, nb::handle edge_edge, nb::handle vertex_edge,
             nb::handle vertex_plane) {
            Candidates made;
            made.vertex_face = id_pairs("vertex_face", vertex_face);
            made.edge_edge = id_pairs("edge_edge", edge_edge);
            made.vertex_edge = id_pairs("vertex_edge", vertex_edge);
            made.vertex_plane = id_pairs("vertex_plane", vertex_plane);
            made.counts.vertex_face = std::int64_t(made.vertex_face.size());
            made.counts.edge_edge = std::int64_t(made.edge_edge.size());
            made.counts.vertex_edge = std::int64_t(made.vertex_edge.size());
            made.counts.vertex_plane = std::int64_t(made.vertex_plane.size());
            new (c) Candidates(std::move(made));
          },
          nb::arg("vertex_face") = nb::none(), nb::arg("edge_edge") = nb::none(),
          nb::arg("vertex_edge") = nb::none(), nb::arg("vertex_plane") = nb::none(),
          nb::sig("def __init__(self, vertex_face: " ONSET_ARRAY_LIKE
                  " | None = None, edge_edge: " ONSET_ARRAY_LIKE
                  " | None = None, vertex_edge: " ONSET_ARRAY_LIKE
                  " | None = None, vertex_plane: " ONSET_ARRAY_LIKE " | None = None) -> None"),
          "#pairs x 2 ids each.")
      .ONSET_ARRAY(Candidates, vertex_face)
      .ONSET_ARRAY(Candidates, edge_edge)
      .ONSET_ARRAY(Candidates, vertex_edge)
      .ONSET_ARRAY(Candidates, vertex_plane)
      .ONSET_FIELD(Candidates, counts)
      .ONSET_FIELD(Candidates, outcome)
      .ONSET_FIELD(Candidates, vertex)
      .ONSET_FIELD(Candidates, stats);
}

// Batches are copies: what the library hands out is gone when its call returns.
Candidates visit(const Mesh& mesh, nb::handle x_t0, nb::handle x_t1, nb::callable visitor,
                 const nb::kwargs& named) {
  const auto hand_over = [&](onset::PairKind kind, const std::array<int, 2>* pairs, std::size_t count) {
    const Callback callback;
    callback.require();
    visitor(kind, taken_array(std::vector<std::array<int, 2>>(pairs, pairs + count)));
  };
  return on_step(mesh, x_t0, x_t1, named,
                 [&](const Mesh& copy, const onset::Positions& x0, const onset::Positions& x1,
                     const onset::Options& options) {
                   return onset::visit_candidates(copy, x0, x1, hand_over, options);
                 });
}

}  // namespace

void bind_candidates(nb::module_& m) {
  bind_list(m);
  m.def(
      "compute_candidates",
      [](const Mesh& mesh, nb::handle x_t0, nb::handle x_t1, const nb::kwargs& options) {
        return on_step(mesh, x_t0, x_t1, options, onset::compute_candidates);
      },
      nb::arg("mesh"), nb::arg("x_t0"), nb::arg("x_t1"), nb::arg("options"),
      ONSET_STEP_SIG("compute_candidates", "Candidates"), doc("compute_candidates"));
  m.def(
      "count_candidates",
      [](const Mesh& mesh, nb::handle x_t0, nb::handle x_t1, const nb::kwargs& options) {
        return on_step(mesh, x_t0, x_t1, options, onset::count_candidates);
      },
      nb::arg("mesh"), nb::arg("x_t0"), nb::arg("x_t1"), nb::arg("options"),
      ONSET_STEP_SIG("count_candidates", "Candidates"), doc("count_candidates"));
  m.def("visit_candidates", &visit, nb::arg("mesh"), nb::arg("x_t0"), nb::arg("x_t1"), nb::arg("visit"),
        nb::arg("options"),
        nb::sig("def visit_candidates(" ONSET_MOTION
                ", visit: Callable[[PairKind, numpy.typing.NDArray[numpy.int32]], object], " ONSET_OPTIONS
                ") -> Candidates"),
        doc("visit_candidates"));
}

}  // namespace onset_python
