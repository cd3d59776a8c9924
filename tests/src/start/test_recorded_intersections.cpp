// Frames of real simulations: the list of intersections against an exact check of every edge and face whose
// boxes overlap.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/scenes/data.hpp"
#include "tests/scenes/frame_file.hpp"
#include "tests/src/start/brute_intersections.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

#ifdef ONSET_ORACLE_GMP
using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
#else
using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
#endif

// The same frame in units in which all coordinates are integers.
std::vector<oracle::Vector<Integer>> on_grid(const Eigen::MatrixXd& x) {
  int last = 1024;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (x.data()[i] != 0) last = std::min(last, std::ilogb(x.data()[i]) - 52);
  std::vector<oracle::Vector<Integer>> points;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    oracle::Vector<Integer> p;
    for (int a = 0; a < 3; ++a) {
      int exponent = 0;
      const auto mantissa = std::int64_t(std::ldexp(std::frexp(x(v, a), &exponent), 53));
      p[std::size_t(a)] = Integer(mantissa);
      if (mantissa != 0) p[std::size_t(a)] <<= unsigned(exponent - 53 - last);
    }
    points.push_back(p);
  }
  return points;
}

struct Box {
  double lo[3], hi[3];
  int id;
};
template <std::size_t N>
Box box_of(const Eigen::MatrixXd& x, const std::array<int, N>& vertices, int id) {
  Box b{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, id};
  for (const int v : vertices)
    for (int a = 0; a < 3; ++a) b.lo[a] = std::min(b.lo[a], x(v, a)), b.hi[a] = std::max(b.hi[a], x(v, a));
  return b;
}

// Along the first axis; visit(edge, face) for each pair of every `stride`-th edge whose closed boxes overlap.
template <class F>
void sweep(const Mesh& mesh, const Eigen::MatrixXd& x, int stride, F&& visit) {
  std::vector<Box> edges, faces;
  for (int e = 0; e < mesh.num_edges(); e += stride) edges.push_back(box_of(x, mesh.edge(e), e));
  for (int f = 0; f < mesh.num_faces(); ++f) faces.push_back(box_of(x, mesh.face(f), f));
  double widest = 0;
  for (const Box& f : faces) widest = std::max(widest, f.hi[0] - f.lo[0]);
  std::sort(faces.begin(), faces.end(), [](const Box& p, const Box& q) { return p.lo[0] < q.lo[0]; });
  for (const Box& e : edges) {
    auto f = std::lower_bound(faces.begin(), faces.end(), e.lo[0] - 1.001 * widest,
                              [](const Box& p, double lo) { return p.lo[0] < lo; });
    for (; f != faces.end() && f->lo[0] <= e.hi[0]; ++f) {
      bool overlap = true;
      for (int a = 0; a < 3; ++a) overlap = overlap && f->lo[a] <= e.hi[a] && e.lo[a] <= f->hi[a];
      if (overlap) visit(e.id, f->id);
    }
  }
}

}  // namespace

TEST_CASE("recorded frames: the intersections are exactly those of all edges and faces", "[oracle]") {
  const std::string data =
      scenes::data_folder("recorded frames: the intersections are exactly those of all edges and faces");
  if (data.empty()) return;
  const int stride = oracle::fuzz(4) < 4 ? 8 : 1;  // all, unless tests are asked to be short
  for (const scenes::RecordedStep& step : scenes::recorded_steps()) {
    const scenes::Recording recording = scenes::read_recording(data, step);
    for (const scenes::Frame* frame : {&recording.t0, &recording.t1}) {
      const Mesh mesh(frame->x, frame->faces);
      const auto points = on_grid(frame->x);
      const auto at = [&](int v) { return points[std::size_t(v)]; };
      std::vector<Found> expected;
      std::size_t looked_at = 0;
      sweep(mesh, frame->x, stride, [&](int e, int f) {
        const auto ends = mesh.edge(e);
        const auto corners = mesh.face(f);
        if (share_vertex(ends, corners)) return;
        ++looked_at;
        const auto kind = oracle::edge_face<Integer>({at(ends[0]), at(ends[1])},
                                                     {at(corners[0]), at(corners[1]), at(corners[2])});
        if (kind) expected.push_back({e, f, *kind});
      });
      std::sort(expected.begin(), expected.end(), [](const Found& p, const Found& q) {
        return std::tie(p.edge, p.face) < std::tie(q.edge, q.face);
      });
      const Intersections found = intersections(mesh, frame->x);
      std::printf("%s, %s: %zu edge-face pairs, %zu crossing, %zu touching, %zu overlapping\n", step.name,
                  frame == &recording.t0 ? "start" : "end", looked_at,
                  found.count(IntersectionKind::crossing), found.count(IntersectionKind::touching),
                  found.count(IntersectionKind::overlapping));
      std::vector<Found> listed = plain(found.pairs);
      listed.erase(
          std::remove_if(listed.begin(), listed.end(), [&](const Found& p) { return p.edge % stride != 0; }),
          listed.end());
      CHECK((listed == expected));
      CHECK(has_intersections(mesh, frame->x) == !found.empty());
    }
  }
}
