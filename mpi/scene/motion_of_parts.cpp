#include "mpi/scene/motion_of_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "broadphase/box_test.hpp"
#include "mpi/scene/axes.hpp"
#include "narrowphase/kernel/float_positions.hpp"

namespace onset::mpi {
namespace {

constexpr std::int64_t kNoVertex = std::numeric_limits<std::int64_t>::max();

void check_shape(const char* name, const Mesh::Impl& m, const Positions& x) {
  if (x.cols() == m.dimension && (x.rows() == m.rows || x.rows() == m.owned)) return;
  if (x.rows() == 0 && m.owned == 0) return;
  throw std::invalid_argument(std::string(name) + " has " + std::to_string(x.rows()) + " rows of " +
                              std::to_string(x.cols()) + " coordinates; this rank has " +
                              std::to_string(m.rows) + " rows, of which it owns " + std::to_string(m.owned) +
                              ", and needs " + std::to_string(m.dimension) + " for each");
}

void fill(const Mesh::Impl& m, const Positions& x_t0, const Positions& x_t1, Motion& motion) {
  motion.num_vertices = int(m.slots());
  motion.in_plane = m.dimension == 2;
  motion.x = AlignedArray<double>(m.slots() * kMotionStride);
  std::fill_n(motion.x.data(), m.slots() * kMotionStride, 0.0);
  for (std::ptrdiff_t v = 0; v < m.owned; ++v) {
    double* x = motion.x.data() + v * kMotionStride;
    for (int a = 0; a < m.dimension; ++a) x[a] = x_t0(v, a), x[4 + a] = x_t1(v, a);
  }
}

// (c) Sets status and bad_vertex: the first vertex of the scene that is not usable.
void find_bad_vertex(const Mesh::Impl& m, Motion& motion) {
  std::int64_t first = kNoVertex;
  for (std::ptrdiff_t v = 0; v < m.owned; ++v) {
    Outcome o = outcome_of_position(motion.t0(int(v)));
    if (o == Outcome::free) o = outcome_of_position(motion.t1(int(v)));
    if (o != Outcome::free)
      first = std::min(first, std::int64_t(m.id[std::size_t(v)]) << 8 | std::int64_t(o));
  }
  m.comm.minimum(&first, 1);
  if (first == kNoVertex) return;
  motion.status = Outcome(first & 0xff);
  motion.bad_vertex = int(first >> 8);
}

// (c)
void require_static(const Mesh::Impl& m, const Motion& motion) {
  std::int64_t first = kNoVertex;
  for (std::size_t v = 0; !m.is_static.empty() && v < std::size_t(m.owned); ++v)
    for (int a = 0; a < 3; ++a)
      if (m.is_static[v] && motion.t0(int(v))[a] != motion.t1(int(v))[a])
        first = std::min(first, std::int64_t(m.id[v]));
  m.comm.minimum(&first, 1);
  if (first != kNoVertex)
    throw std::invalid_argument("vertex " + std::to_string(first) + " is static, but x_t0 and x_t1 differ");
}

// Raises `moved` to what the vertices of an element move that takes part and is not wholly static.
template <std::size_t N>
void add_moved(const Motion& motion, const std::array<int, N>& slots, TakesPart part, double* moved) {
  if (part != TakesPart::moving) return;
  for (const int v : slots)
    for (int a = 0; a < 3; ++a) moved[a] = std::max(moved[a], std::fabs(motion.t1(v)[a] - motion.t0(v)[a]));
}

// Raises `widest` to the swept extent of an element, rounded up as that of largest_swept is.
template <std::size_t N>
void add_swept(const Motion& motion, const std::array<int, N>& slots, std::array<double, 3>& widest) {
  for (std::size_t a = 0; a < 3; ++a) {
    double lo = motion.t0(slots[0])[a], hi = lo;
    for (const int v : slots) {
      lo = std::min({lo, motion.t0(v)[a], motion.t1(v)[a]});
      hi = std::max({hi, motion.t0(v)[a], motion.t1(v)[a]});
    }
    widest[a] = std::max(widest[a], (hi - lo) * (1 + 0x1p-52));
  }
}

// All are largest values, by the caller's axes: of coordinates, of coordinates times -1, of magnitudes.
struct Measures {
  double upper[3], lower[3], largest, moved[3];
  std::array<double, 3> edge, face;
};

Measures measure(const Mesh::Impl& m, const Motion& motion) {
  Measures r{};
  for (int a = 0; a < 3; ++a) r.upper[a] = r.lower[a] = -std::numeric_limits<double>::infinity();
  for (int v = 0; v < int(m.owned); ++v) {
    for (const double* x : {motion.t0(v), motion.t1(v)})
      for (int a = 0; a < 3; ++a) {
        r.upper[a] = std::max(r.upper[a], x[a]), r.lower[a] = std::max(r.lower[a], -x[a]);
        r.largest = std::max(r.largest, std::fabs(x[a]));
      }
    add_moved(motion, std::array<int, 1>{v}, m.takes_part[0][std::size_t(v)], r.moved);
  }
  for (std::size_t i = 0; i < m.own_edges.size(); ++i) {
    add_moved(motion, m.own_edges[i].vertices, m.takes_part[1][i], r.moved);
    if (m.takes_part[1][i] != TakesPart::no) add_swept(motion, m.own_edges[i].vertices, r.edge);
  }
  for (std::size_t i = 0; i < m.own_faces.size(); ++i) {
    add_moved(motion, m.own_faces[i].vertices, m.takes_part[2][i], r.moved);
    if (m.takes_part[2][i] != TakesPart::no) add_swept(motion, m.own_faces[i].vertices, r.face);
  }
  return r;
}

// (c)
bool moving_boxes_are_cheaper(const Mesh::Impl& m, const Motion& motion) {
  struct Row {
    std::int64_t place;
    EdgeSample sample;
  };
  std::vector<Row> mine;
  m.comm.agreed([&] {
    for (const auto& [place, edge] : m.samples)
      mine.push_back({place, sample_edge(motion, m.own_edges[std::size_t(edge)].vertices)});
  });
  std::vector<Row> all = m.comm.gather(mine);
  bool moving = false;
  m.comm.agreed([&] {
    std::sort(all.begin(), all.end(), [](const Row& x, const Row& y) { return x.place < y.place; });
    std::vector<EdgeSample> samples;
    for (const Row& row : all) samples.push_back(row.sample);
    moving = cheaper_box_test(samples) == BoxTest::moving;
  });
  return moving;
}

// (c) The middle of the scene, by the caller's axes.
std::array<double, 3> middle_of_scene(const Mesh::Impl& m, const Motion& motion) {
  std::vector<std::array<double, 3>> mine;
  m.comm.agreed([&] {
    const int stride = stride_of_middle(int(m.vertices));
    for (int v = 0; v < int(m.owned); ++v)
      if (m.id[std::size_t(v)] % stride == 0)
        mine.push_back({motion.t0(v)[0], motion.t0(v)[1], motion.t0(v)[2]});
  });
  std::vector<std::array<double, 3>> all = m.comm.gather(mine);
  std::array<double, 3> middle{};
  m.comm.agreed([&] { middle = middle_of(std::move(all)); });
  return middle;
}

}  // namespace

OwnMotion take_motion(const Mesh::Impl& m, const Positions& x_t0, const Positions& x_t1) {
  OwnMotion r;
  m.comm.agreed([&] {
    check_shape("x_t0", m, x_t0), check_shape("x_t1", m, x_t1);
    fill(m, x_t0, x_t1, r.motion);
  });
  find_bad_vertex(m, r.motion);
  if (r.motion.status != Outcome::free) return r;
  m.halo.fill(m.comm, r.motion.x.data(), kMotionStride);
  require_static(m, r.motion);
  static_assert(sizeof(Measures) == 16 * sizeof(double));
  Measures all = measure(m, r.motion);
  m.comm.maximum(reinterpret_cast<double*>(&all), 16);
  WholeScene& w = r.whole;
  w.here = m.comm.rank();
  w.has_edges = m.edges > 0, w.has_faces = m.faces > 0, w.has_static = m.has_static;
  w.axes = scene_axes(m, r.motion, all.upper, all.lower);
  const std::array<double, 3> middle = middle_of_scene(m, r.motion);
  w.rounds_all = rounds_all(std::size_t(m.static_vertices), std::ptrdiff_t(m.vertices));
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t of = std::size_t(w.axes[a]);
    w.moved[a] = all.moved[of], w.widest_edge[a] = all.edge[of], w.widest_face[a] = all.face[of];
    w.middle[a] = middle[of];
  }
  w.largest_coordinate = all.largest;
  w.tests_moving_boxes = moving_boxes_are_cheaper(m, r.motion);
  return r;
}

void take_direction(const Mesh::Impl& m, const Positions& dx, OwnMotion& own) {
  m.comm.agreed([&] {
    own.direction.assign(3 * m.slots(), 0.0);
    for (std::ptrdiff_t v = 0; v < m.owned; ++v)
      for (int a = 0; a < m.dimension; ++a) own.direction[std::size_t(3 * v + a)] = dx(v, a);
  });
  m.halo.fill(m.comm, own.direction.data(), 3);
}

}  // namespace onset::mpi
