#include "src/trajectory/pieces.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "broadphase/interval.hpp"
#include "scene/motion/storing.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 512;
constexpr double kCoarse = 0x1p-5;

}  // namespace

Motion standing_still(const std::vector<double>& x0) {
  Motion motion;
  motion.num_vertices = int(x0.size() / 3);
  motion.x = AlignedArray<double>(x0.size() / 3 * kMotionStride);
  for (std::size_t v = 0; v < x0.size() / 3; ++v) {
    double* x = motion.x.data() + v * kMotionStride;
    x[3] = x[7] = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double from = x0[3 * v + a];
      x[a] = x[4 + a] = std::fabs(from) <= kMaxCoordinate ? from : 0;
    }
  }
  return motion;
}

Pieces::Pieces(TurningScene& scene, const Trajectory& trajectory, const std::vector<double>& x0,
               const std::vector<double>& x1)
    : scene_(scene), trajectory_(trajectory), x0_(x0), x1_(x1), bound_(x0.size() / 3) {
  motion_ = standing_still(x0);
  scene.pieces->thickness.assign(x0.size() / 3, 0);
}

void Pieces::put_linear(int v, double t, double* x) const {
  const double *from = &x0_[3 * std::size_t(v)], *to = &x1_[3 * std::size_t(v)];
  for (int a = 0; a < 3; ++a) x[a] = stored_between(from[a], to[a], t);
}

// The ends of the chord and what is stored on the way err by 5 sqrt(3) u M each, in any of the orders of
// operations that docs/steps.md names; what does not move is stored as it is.
double Pieces::linear_bound(int v) const {
  double largest = 0;
  bool moves = false;
  for (std::size_t i = 3 * std::size_t(v); i < 3 * std::size_t(v) + 3; ++i) {
    largest = std::max({largest, std::fabs(x0_[i]), std::fabs(x1_[i])});
    moves = moves || x0_[i] != x1_[i];
  }
  return moves ? kStoring * largest + 0x1p-1070 : 0;
}

void Pieces::fill(double t0, double t1, const int* vertices, std::size_t count) {
  std::vector<int> turning;
  for (std::size_t i = 0; i < count; ++i) {
    const int v = vertices[i];
    double* x = motion_.x.data() + std::size_t(v) * kMotionStride;
    x[3] = x[7] = 0;
    if (scene_.body[std::size_t(v)] != Trajectory::kLinear) {
      turning.push_back(v);
      continue;
    }
    put_linear(v, t0, x), put_linear(v, t1, x + 4);
    bound_[std::size_t(v)] = linear_bound(v);
  }
  std::vector<double> at(3 * turning.size());
  for (const int end : {0, 1}) {
    trajectory_.positions(end == 0 ? t0 : t1, turning.data(), turning.size(), at.data());
    for (std::size_t i = 0; i < turning.size(); ++i)
      std::copy_n(&at[3 * i], 3, motion_.x.data() + std::size_t(turning[i]) * kMotionStride + 4 * end);
  }
  trajectory_.straying(t0, t1, turning.data(), turning.size(), at.data());
  for (std::size_t i = 0; i < turning.size(); ++i) bound_[std::size_t(turning[i])] = at[i];
}

bool Pieces::set(double t0, double t1, const std::vector<int>& vertices) {
  t0_ = t0, t1_ = t1, largest_ = 0;
  parallel_ranges(vertices.size(), kGrain, [&](std::size_t first, std::size_t last) {
    fill(t0, t1, vertices.data() + first, last - first);
  });
  for (const int v : vertices) {
    const double bound = bound_[std::size_t(v)];
    note(fault_of(v, motion_.t0(v), motion_.t1(v), bound), v);
    largest_ = std::max(largest_, bound);
  }
  if (fault_.outcome != Outcome::free) return false;
  std::vector<double>& thickness = scene_.pieces->thickness;
  for (const int v : vertices) {
    const std::size_t i = std::size_t(v);
    thickness[i] = scene_.thickness.empty() ? bound_[i] : (scene_.thickness[i] + largest_) * (1 + 0x1p-51);
  }
  return true;
}

// The share is taken off by 2^-40, and the sum rounds by half the distance of two doubles.
double Pieces::time_at(double share) const {
  const double t = t0_ + share * (t1_ - t0_) * (1 - 0x1p-40);
  return std::max(t0_, std::nextafter(t, -1));
}

bool Pieces::divisible() const { return middle() > t0_ && middle() < t1_; }

double Pieces::added(const std::array<int, 4>& vertices, PairKind kind) const {
  double largest[2] = {0, 0};
  for (int i = 0; i < 4; ++i) {
    double& side = largest[i >= points_of_first_side(kind)];
    side = std::max(side, bound_[std::size_t(vertices[std::size_t(i)])]);
  }
  return (largest[0] + largest[1]) * (1 + 0x1p-52);
}

double Pieces::rounding_at(double t, int v) {
  if (scene_.body[std::size_t(v)] == Trajectory::kLinear) return linear_bound(v);
  double bound = 0;
  const Fault fault = ask_straying(trajectory_, t, t, &v, 1, &bound);
  note(fault.outcome, v);
  return bound;
}

double Pieces::rounding(const std::array<int, 4>& vertices, PairKind kind) {
  double largest[2] = {0, 0};
  for (int i = 0; i < 4; ++i) {
    double& side = largest[i >= points_of_first_side(kind)];
    side = std::max(side, rounding_at(middle(), vertices[std::size_t(i)]));
  }
  return largest[0] + largest[1];
}

double Pieces::largest_rounding(const std::vector<int>& vertices) {
  std::vector<double> bounds(vertices.size());
  const Fault fault = ask_straying(trajectory_, 1, 1, vertices.data(), vertices.size(), bounds.data());
  note(fault.outcome, fault.vertex);
  return bounds.empty() ? 0 : *std::max_element(bounds.begin(), bounds.end());
}

// The sums round by less than 2^-52 of themselves.
VertexBox Pieces::box(int v, double t0, double t1) {
  double x[2][3], bound = linear_bound(v);
  if (scene_.body[std::size_t(v)] == Trajectory::kLinear) {
    put_linear(v, t0, x[0]), put_linear(v, t1, x[1]);
  } else {
    trajectory_.positions(t0, &v, 1, x[0]), trajectory_.positions(t1, &v, 1, x[1]);
    trajectory_.straying(t0, t1, &v, 1, &bound);
    note(fault_of(v, x[0], x[1], bound), v);
  }
  VertexBox r;
  for (std::size_t a = 0; a < 3; ++a) {
    r.lo[a] = widen_down(std::min(x[0][a], x[1][a]), bound);
    r.hi[a] = widen_up(std::max(x[0][a], x[1][a]), bound);
  }
  return r;
}

bool Pieces::is_coarse(const std::vector<int>& vertices, double enough) {
  const auto worst = std::max_element(vertices.begin(), vertices.end(), [&](int v, int w) {
    return bound_[std::size_t(v)] < bound_[std::size_t(w)];
  });
  if (worst == vertices.end()) return false;
  const double bound = bound_[std::size_t(*worst)];
  double way = 0;
  for (int a = 0; a < 3; ++a) way = std::max(way, std::fabs(motion_.t1(*worst)[a] - motion_.t0(*worst)[a]));
  return bound > enough && bound > kCoarse * way && bound > 2 * rounding_at(t1_, *worst);
}

}  // namespace onset
