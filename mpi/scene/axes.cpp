#include "mpi/scene/axes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "scene/motion/canonical_axes.hpp"

namespace onset::mpi {
namespace {

constexpr std::int64_t kNowhere = std::numeric_limits<std::int64_t>::max();
constexpr std::array<std::array<int, 2>, 3> kPairs{{{0, 1}, {0, 2}, {1, 2}}};

// (c) Returns the start of vertex 0, from which compare_columns measures.
std::array<double, 3> first_position(const Mesh::Impl& m, const Motion& motion) {
  std::array<double, 3> x;
  x.fill(-std::numeric_limits<double>::infinity());
  if (m.owned > 0 && m.by_id.size() > 0) {
    const int slot = m.by_id[0];
    if (m.id[std::size_t(slot)] == 0 && slot < m.owned) std::copy_n(motion.t0(slot), 3, x.begin());
  }
  m.comm.maximum(x.data(), 3);
  return x;
}

// Calls f(place, differences) for the ends of all vertices owned here, in the order of ids, until it returns
// false; `place` is larger for later ones, in the scene.
template <class F>
void each_end(const Mesh::Impl& m, const Motion& motion, const std::array<double, 3>& first, F&& f) {
  for (const int slot : m.by_id) {
    if (slot >= m.owned) continue;
    for (int end = 0; end < 2; ++end) {
      const double* x = end == 0 ? motion.t0(slot) : motion.t1(slot);
      Difference d[3];
      for (std::size_t a = 0; a < 3; ++a) d[a] = exact_difference(x[a], first[a]);
      if (!f(2 * std::int64_t(m.id[std::size_t(slot)]) + end, d)) return;
    }
  }
}

// Compares as compare_columns does one end of one vertex.
int compare(const Difference& x, double x_sign, const Difference& y, double y_sign) {
  const Difference d[2] = {{x.rounded * x_sign, x.rest * x_sign}, {y.rounded * y_sign, y.rest * y_sign}};
  if (d[0].rounded != d[1].rounded) return d[0].rounded > d[1].rounded ? -1 : 1;
  if (d[0].rest != d[1].rest) return d[0].rest > d[1].rest ? -1 : 1;
  return 0;
}

double sign_of(const Difference& d) { return d.rounded > 0 ? 1 : -1; }

// What the first end in the scene says for which there is something to say: 4 place + answer.
struct First {
  std::int64_t code = kNowhere;
  bool known() const { return code != kNowhere; }
  void offer(std::int64_t place, int answer) { code = std::min(code, 4 * place + answer + 1); }
  int answer() const { return int(code & 3) - 1; }
};

// (c) The comparisons of kPairs, where columns have the same width.
std::array<int, 3> compare_all(const Mesh::Impl& m, const Motion& motion) {
  const std::array<double, 3> first = first_position(m, motion);
  First magnitude[3], sign[3], oriented[3];
  each_end(m, motion, first, [&](std::int64_t place, const Difference* d) {
    bool all = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = kPairs[k];
      const int c = compare(d[i], sign_of(d[i]), d[j], sign_of(d[j]));
      if (!magnitude[k].known() && c != 0) magnitude[k].offer(place, c);
      if (!sign[k].known() && d[k].rounded != 0) sign[k].offer(place, d[k].rounded > 0 ? 1 : -1);
      all = all && magnitude[k].known() && sign[k].known();
    }
    return !all;
  });
  std::int64_t codes[6] = {magnitude[0].code, magnitude[1].code, magnitude[2].code,
                           sign[0].code,      sign[1].code,      sign[2].code};
  m.comm.minimum(codes, 6);
  double signs[3];
  for (std::size_t k = 0; k < 3; ++k) {
    magnitude[k].code = codes[k], sign[k].code = codes[3 + k];
    signs[k] = sign[k].known() ? sign[k].answer() : 0;
  }
  each_end(m, motion, first, [&](std::int64_t place, const Difference* d) {
    bool all = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = kPairs[k];
      const int c = compare(d[i], signs[i], d[j], signs[j]);
      if (!oriented[k].known() && c != 0) oriented[k].offer(place, c);
      all = all && oriented[k].known();
    }
    return !all;
  });
  std::int64_t last[3] = {oriented[0].code, oriented[1].code, oriented[2].code};
  m.comm.minimum(last, 3);
  std::array<int, 3> answers{};
  for (std::size_t k = 0; k < 3; ++k) {
    oriented[k].code = last[k];
    answers[k] = magnitude[k].known()  ? magnitude[k].answer()
                 : oriented[k].known() ? oriented[k].answer()
                                       : 0;
  }
  return answers;
}

}  // namespace

std::array<int, 3> scene_axes(const Mesh::Impl& m, const Motion& motion, const double* upper,
                              const double* lower) {
  if (m.vertices == 0) return {0, 1, 2};
  double width[3];
  for (int a = 0; a < 3; ++a) width[a] = upper[a] + lower[a];
  if (m.dimension == 2) width[2] = -1;
  const bool ties = width[0] == width[1] || width[0] == width[2] || width[1] == width[2];
  const std::array<int, 3> order = ties ? compare_all(m, motion) : std::array<int, 3>{};
  const auto before = [&](int i, int j) {
    if (width[i] != width[j]) return width[i] > width[j];
    if (i == j) return false;
    return i < j ? order[std::size_t(i + j - 1)] < 0 : order[std::size_t(i + j - 1)] > 0;
  };
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), before);
  return axes;
}

}  // namespace onset::mpi
