#include "broadphase/box_test.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/mesh_data.hpp"
#include "scene/motion/motion.hpp"
#include "scene/pairs/whole_scene.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {
namespace {

constexpr std::size_t kSamples = 256;  // edges, at least and up to twice as many
// Measured: with a motion of 1 size a step with the moving test costs a seventh more, of 3 a tenth less, of 5
// less than half.
constexpr double kSizesMoved = 2;
constexpr double kMostSizes = 16;  // of one edge: one that has flown off decides nothing

// Negating all numbers negates it, so that a flipped scene gets the same test.
double median(std::vector<double> x) {
  const auto upper = x.begin() + std::ptrdiff_t(x.size() / 2);
  std::nth_element(x.begin(), upper, x.end());
  const double lower = x.size() % 2 == 1 ? *upper : *std::max_element(x.begin(), upper);
  return 0.5 * lower + 0.5 * *upper;
}

std::vector<int> some_moving_edges(const MeshData& mesh) {
  const PrimitiveFilter& filter = *mesh.filter;
  const bool all = filter.all;
  const std::vector<int>* moving = all ? nullptr : &filter.moving[std::size_t(Primitive::edge)];
  const std::size_t count = all ? mesh.edges.size() : moving->size();
  std::vector<int> edges;
  const std::size_t stride = sampled_edge_stride(count);
  for (std::size_t i = 0; i < count; i += stride) edges.push_back(all ? int(i) : (*moving)[i]);
  return edges;
}

// Says whether no edge can move more than kSizesMoved sizes against the others, without a median: most edges
// are long enough beside the largest difference of two moves. The usual size is then no less than they are,
// and no move is further from the common one than from the farthest.
bool moves_little(const std::vector<double>& size, const std::vector<double> (&moved)[3]) {
  double apart = 0;
  for (const std::vector<double>& m : moved) {
    const auto [least, most] = std::minmax_element(m.begin(), m.end());
    apart = std::max(apart, *most - *least);
  }
  const auto is_long = [&](double s) { return kSizesMoved * s >= apart; };
  return 2 * std::size_t(std::count_if(size.begin(), size.end(), is_long)) > size.size();
}

}  // namespace

std::size_t sampled_edge_stride(std::size_t moving_edges) {
  return std::max<std::size_t>(1, moving_edges / kSamples);
}

EdgeSample sample_edge(const Motion& motion, const std::array<int, 2>& edge) {
  EdgeSample r{};
  for (std::size_t a = 0; a < 3; ++a) {
    r.size = std::max(r.size, std::fabs(motion.t0(edge[0])[a] - motion.t0(edge[1])[a]));
    r.moved[a] = motion.t1(edge[0])[a] - motion.t0(edge[0])[a];
  }
  return r;
}

BoxTest cheaper_box_test(const MeshData& mesh, const Motion& motion) {
  if (mesh.whole) return mesh.whole->tests_moving_boxes ? BoxTest::moving : BoxTest::both_ends;
  std::vector<EdgeSample> samples;
  for (int e : some_moving_edges(mesh)) samples.push_back(sample_edge(motion, mesh.edges[std::size_t(e)]));
  return cheaper_box_test(samples);
}

BoxTest cheaper_box_test(const std::vector<EdgeSample>& samples) {
  std::vector<double> size, moved[3];
  for (const EdgeSample& sample : samples) {
    size.push_back(sample.size);
    for (std::size_t a = 0; a < 3; ++a) moved[a].push_back(sample.moved[a]);
  }
  if (size.empty() || moves_little(size, moved)) return BoxTest::both_ends;
  const double usual = median(size);
  if (usual == 0) return BoxTest::both_ends;
  const double common[3] = {median(moved[0]), median(moved[1]), median(moved[2])};
  double sizes = 0;  // sum over edges: how many sizes each moves against the others
  for (std::size_t i = 0; i < size.size(); ++i) {
    double most = 0;
    for (int a = 0; a < 3; ++a) most = std::max(most, std::fabs(moved[a][i] - common[a]));
    sizes += std::min(most / usual, kMostSizes);
  }
  return sizes > kSizesMoved * double(size.size()) ? BoxTest::moving : BoxTest::both_ends;
}

}  // namespace onset
