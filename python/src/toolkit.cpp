// What the classes of onset_ccd.ipc_toolkit ask: pairs and boxes in the way of ipc-toolkit's classes.
#include <onset/compat/box_pairs.hpp>
#include <onset/compat/pair_queries.hpp>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"

namespace onset_python {
namespace {

using onset::compat::Box, onset::compat::PairMotion;

// Four points of a pair, or three in the plane.
std::array<onset::Point, 4> points_of(const char* name, nb::handle values, onset::PairKind kind) {
  const DoublesArgument x(name, values);
  const bool in_plane = kind == onset::PairKind::vertex_edge;
  const std::ptrdiff_t rows = in_plane ? 3 : 4, columns = in_plane ? 2 : 3;
  x.require_shape(name, rows, columns);
  std::array<onset::Point, 4> points{};
  for (std::ptrdiff_t r = 0; r < 4; ++r)
    for (std::ptrdiff_t a = 0; a < columns; ++a)
      points[std::size_t(r)][std::size_t(a)] = x(std::min(r, rows - 1), a);
  return points;
}

std::vector<Box> boxes_of(const char* name, nb::handle values) {
  const DoublesArgument x(name, values);
  if (x.axes() != 2 || x.cols() != 6) throw std::invalid_argument(std::string(name) + " must be #boxes x 6");
  std::vector<Box> boxes(static_cast<std::size_t>(x.rows()));
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t a = 0; a < 3; ++a) {
      boxes[i].lo[a] = x(std::ptrdiff_t(i), std::ptrdiff_t(a));
      boxes[i].hi[a] = x(std::ptrdiff_t(i), std::ptrdiff_t(a) + 3);
    }
  return boxes;
}

}  // namespace

void bind_toolkit(nb::module_& m) {
  m.def(
      "_time_of_impact",
      [](onset::PairKind kind, nb::handle t0, nb::handle t1, double min_distance, double tmax,
         double rescaling, double tolerance, long max_iterations, long default_iterations) {
        PairMotion motion;
        motion.kind = kind, motion.t0 = points_of("t0", t0, kind), motion.t1 = points_of("t1", t1, kind);
        onset::Options options = onset::compat::options_of_iterations(max_iterations, default_iterations);
        options.tolerance = tolerance;
        return onset::compat::time_of_impact(motion, min_distance, tmax, rescaling, options);
      },
      "How far a pair may go and keep its share of its gap: infinite where it may go beyond tmax.");
  m.def(
      "_overlapping_boxes",
      [](nb::handle a, nb::handle b) {
        const std::vector<Box> first = boxes_of("a", a);
        const std::vector<Box> second = b.is_none() ? std::vector<Box>{} : boxes_of("b", b);
        const bool same = b.is_none();
        return taken_array(
            without_lock([&] { return onset::compat::overlapping_boxes(first, same ? nullptr : &second); }));
      },
      nb::arg("a"), nb::arg("b").none(),
      "Every pair of boxes (lower corner, upper corner) that overlap, sorted.");
}

}  // namespace onset_python
