// One pair on its own.
#include <onset/query.hpp>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/fields.hpp"
#include "conversion/options.hpp"
#include "conversion/reprs.hpp"
#include "conversion/signatures.hpp"

namespace onset_python {
namespace {

using onset::QueryResult;

// Points of a query, one row each.
template <std::size_t Rows, std::size_t Axes>
std::array<std::array<double, Axes>, Rows> points(const char* name, nb::handle values) {
  const DoublesArgument x(name, values);
  x.require_shape(name, Rows, Axes);
  std::array<std::array<double, Axes>, Rows> result;
  for (std::size_t r = 0; r < Rows; ++r)
    for (std::size_t a = 0; a < Axes; ++a) result[r][a] = x(std::ptrdiff_t(r), std::ptrdiff_t(a));
  return result;
}

template <class Query, std::size_t Rows, std::size_t Axes, class Call>
void bind_query(nb::module_& m, const char* name, const char* signature, const Call& call) {
  m.def(
      name,
      [call](nb::handle t0, nb::handle t1, const nb::kwargs& named) {
        Query query;
        query.t0 = points<Rows, Axes>("t0", t0), query.t1 = points<Rows, Axes>("t1", t1);
        return call(query, query_options_of(named));
      },
      nb::arg("t0"), nb::arg("t1"), nb::arg("options"), nb::sig(signature), doc("vertex_face_ccd"));
}

#define ONSET_QUERY_SIG(name) \
  "def " name "(t0: " ONSET_ARRAY_LIKE ", t1: " ONSET_ARRAY_LIKE ", " ONSET_OPTIONS ") -> QueryResult"

}  // namespace

void bind_queries(nb::module_& m) {
  nb::class_<QueryResult, onset::Contact>(m, "QueryResult", doc("QueryResult"))
      .def_ro("checks", &QueryResult::checks)
      .def("collides", &QueryResult::collides)
      .def("__repr__", [](const QueryResult& r) {
        return "QueryResult(toi=" + text_of(r.toi) + ", outcome=" + onset::to_string(r.outcome) + ")";
      });
  bind_query<onset::VertexFaceQuery, 4, 3>(m, "vertex_face_ccd", ONSET_QUERY_SIG("vertex_face_ccd"),
                                           onset::vertex_face_ccd);
  bind_query<onset::EdgeEdgeQuery, 4, 3>(m, "edge_edge_ccd", ONSET_QUERY_SIG("edge_edge_ccd"),
                                         onset::edge_edge_ccd);
  bind_query<onset::VertexEdgeQuery, 3, 2>(m, "vertex_edge_ccd", ONSET_QUERY_SIG("vertex_edge_ccd"),
                                           onset::vertex_edge_ccd);
}

}  // namespace onset_python
