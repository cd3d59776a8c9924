#include "narrowphase/inclusion.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

namespace onset {
namespace {

constexpr double kLateness = 0x1p-48;  // by so much a box's first time may be late

constexpr double kEta = 0x1p-1074;

// A part of the domain with F at its corners. Edge-edge: a box of (t, u, v), corner 4 it + 2 iu + iv.
// Vertex-face: an interval of t times a part of the triangle, corner 3 it + j.
//
// F is affine in each of t, u, v (and on a triangle), so a midpoint corner is the mean of two (paper, eq. 6).
// The running bound per axis is |m^ - m| <= (e + e)/2 + u |m^| + eta/2 (docs/theory.md, L20).
struct Box {
  double f[8][3];
  double error[3];
  double t0, t1;
  int depth;
};

class Search {
 public:
  explicit Search(const InclusionInput& input) : in_(input), per_end_(input.corners.count) {}

  InclusionResult run() {
    if (!separated(push_root())) order_.push(0);
    result_.checks = 1;
    while (!order_.empty()) {
      const int i = order_.top();
      const Box box = boxes_[i];
      if (small(box)) return stop(InclusionResult::End::contact, box);
      if (result_.checks + 2 > in_.max_checks || boxes_in_use() + 1 >= kInclusionBoxes)
        return stop(InclusionResult::End::max_checks, box);
      order_.pop();
      free_.push_back(i);
      split(box);
    }
    result_.end = InclusionResult::End::free;
    result_.t = 1;
    return result_;
  }

 private:
  const Box& push_root() {
    Box root{};
    double begin[4][3];
    in_.corners.at(in_.t_begin, begin);
    for (int k = 0; k < per_end_; ++k)
      for (int a = 0; a < 3; ++a) {
        root.f[k][a] = begin[k][a];
        root.f[per_end_ + k][a] = in_.corners.c[1][k][a];
      }
    // A corner at t_begin carries 4 roundings; 4.25 covers second order.
    for (int a = 0; a < 3; ++a)
      root.error[a] = 4.25 * kU * largest(root, a) * (1 + 0x1p-50) + kEta + corner_floor(a);
    root.t0 = in_.t_begin;
    root.t1 = 1;
    root.depth = 0;
    boxes_.push_back(root);
    return boxes_.back();
  }

  // The lerp at t_begin may cancel: its error is relative to the ends.
  double corner_floor(int a) const {
    double m = 0;
    for (const auto& end : in_.corners.c)
      for (int k = 0; k < per_end_; ++k) m = std::max(m, std::fabs(end[k][a]));
    return 4.25 * kU * m * (1 + 0x1p-50);
  }

  double largest(const Box& b, int a) const {
    double m = 0;
    for (int k = 0; k < 2 * per_end_; ++k) m = std::max(m, std::fabs(b.f[k][a]));
    return m;
  }

  std::size_t boxes_in_use() const { return boxes_.size() - free_.size(); }

  // The largest change of F on an axis.
  static double change(const Box& b, int i, int j) {
    double m = 0;
    for (int a = 0; a < 3; ++a) m = std::max(m, std::fabs(b.f[i][a] - b.f[j][a]));
    return m;
  }

  // Tells whether the box of F's corners, grown by the error, misses the ball (or cube) of radius d (paper,
  // line 9; docs/theory.md, L21).
  bool separated(const Box& b) const {
    const double d = in_.separation;
    double squares = 0;
    for (int a = 0; a < 3; ++a) {
      double lo = b.f[0][a], hi = lo;
      for (int k = 1; k < 2 * per_end_; ++k) lo = std::min(lo, b.f[k][a]), hi = std::max(hi, b.f[k][a]);
      const double gap = (std::max(lo, -hi) - b.error[a]) * (1 - 0x1p-50);
      if (gap > d) return true;
      if (gap > 0) squares += gap * gap;
    }
    // The sum of squares and its root err by less than 4u.
    if (!in_.maximum_norm && std::sqrt(squares) * (1 - 0x1p-49) > d) return true;
    return separated_along_axes(b);
  }

  // Any n with n.F > d |n| at all corners (|n|_1 for the cube) rejects too; this tries the pair's normal and
  // the mean of the corners.
  bool separated_along_axes(const Box& b) const {
    double u[3], v[3], n[3], mean[3] = {};
    const int k = per_end_;
    for (int a = 0; a < 3; ++a) {
      u[a] = k == 4 ? b.f[2][a] - b.f[0][a] + b.f[6][a] - b.f[4][a]
                    : b.f[1][a] - b.f[0][a] + b.f[4][a] - b.f[3][a];
      v[a] = k == 4 ? b.f[1][a] - b.f[0][a] + b.f[5][a] - b.f[4][a]
                    : b.f[2][a] - b.f[0][a] + b.f[5][a] - b.f[3][a];
      for (int i = 0; i < 2 * k; ++i) mean[a] += b.f[i][a];
    }
    for (int a = 0; a < 3; ++a) n[a] = u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3];
    return separated_along(b, n) || separated_along(b, mean);
  }

  bool separated_along(const Box& b, double (&n)[3]) const {
    const double size = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
    if (!(size > 0x1p-900)) return false;
    double lo = INFINITY, hi = -INFINITY, error = 0;
    for (double& x : n) x /= size;  // any direction will do
    for (int a = 0; a < 3; ++a) error += std::fabs(n[a]) * (b.error[a] + 4 * kU * largest(b, a));
    for (int i = 0; i < 2 * per_end_; ++i) {
      const double p = (n[0] * b.f[i][0] + n[1] * b.f[i][1]) + n[2] * b.f[i][2];
      lo = std::min(lo, p), hi = std::max(hi, p);
    }
    const double norm = in_.maximum_norm ? std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2])
                                         : std::sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    const double wanted = (error * (1 + 0x1p-48) + in_.separation * norm * (1 + 0x1p-48)) + kEta;
    return std::max(lo, -hi) > wanted;
  }

  // Tells whether every point of the box is within sqrt(3) delta/2 < delta of one within d (paper, line 15;
  // docs/theory.md, L22), or it is too narrow to halve.
  bool small(const Box& b) const {
    const double middle = 0.5 * (b.t0 + b.t1);
    const bool can_halve = b.t0 < middle && middle < b.t1;
    double width = 0;
    for (int a = 0; a < 3; ++a) {
      double lo = b.f[0][a], hi = lo;
      for (int k = 1; k < 2 * per_end_; ++k) lo = std::min(lo, b.f[k][a]), hi = std::max(hi, b.f[k][a]);
      width = std::max(width, hi - lo);
    }
    return width <= 0.5 * in_.tolerance || (!can_halve && change_in_time(b) >= change_in_space(b)) ||
           b.depth > 1000;
  }

  double change_in_time(const Box& b) const {
    double m = 0;
    for (int k = 0; k < per_end_; ++k) m = std::max(m, change(b, k, per_end_ + k));
    return m;
  }
  double change_in_space(const Box& b) const {
    double m = 0;
    for (int end = 0; end < 2 * per_end_; end += per_end_)
      for (int i = 0; i < per_end_; ++i)
        for (int j = 0; j < i; ++j) m = std::max(m, change(b, end + i, end + j));
    return m;
  }

  // Halves the part of the domain along which F changes most (paper, eq. 7 and line 28).
  void split(const Box& b) {
    const double middle = 0.5 * (b.t0 + b.t1);
    const bool can_halve_time = b.t0 < middle && middle < b.t1;
    if (per_end_ == 4) {
      const double in_u = std::max({change(b, 0, 2), change(b, 1, 3), change(b, 4, 6), change(b, 5, 7)});
      const double in_v = std::max({change(b, 0, 1), change(b, 2, 3), change(b, 4, 5), change(b, 6, 7)});
      if (can_halve_time && change_in_time(b) >= std::max(in_u, in_v))
        return halve(b, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}, true);
      if (in_u >= in_v) return halve(b, {{0, 2}, {1, 3}, {4, 6}, {5, 7}}, false);
      return halve(b, {{0, 1}, {2, 3}, {4, 5}, {6, 7}}, false);
    }
    if (can_halve_time && change_in_time(b) >= change_in_space(b))
      return halve(b, {{0, 3}, {1, 4}, {2, 5}}, true);
    int side = 0;
    double longest = -1;
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3;
      const double length = std::max(change(b, j, k), change(b, 3 + j, 3 + k));
      if (length > longest) longest = length, side = j;
    }
    const int k = (side + 1) % 3;
    halve(b, {{side, k}, {3 + side, 3 + k}}, false);
  }

  struct Ends {
    int from, to;
  };
  void halve(const Box& b, std::initializer_list<Ends> edges, bool in_time) {
    Box lower = b, upper = b;
    double size[3] = {};
    for (const Ends e : edges)
      for (int a = 0; a < 3; ++a) {
        const double m = 0.5 * (b.f[e.from][a] + b.f[e.to][a]);
        lower.f[e.to][a] = upper.f[e.from][a] = m;
        size[a] = std::max(size[a], std::fabs(m));
      }
    for (int a = 0; a < 3; ++a)
      lower.error[a] = upper.error[a] = (b.error[a] + kU * size[a]) * (1 + 4 * kU) + kEta;
    if (in_time) lower.t1 = upper.t0 = 0.5 * (b.t0 + b.t1);
    lower.depth = upper.depth = b.depth + 1;
    keep(lower);
    keep(upper);
  }

  void keep(const Box& b) {
    ++result_.checks;
    if (separated(b)) return;
    int slot;
    if (free_.empty()) {
      slot = int(boxes_.size());
      boxes_.push_back(b);
    } else {
      slot = free_.back();
      free_.pop_back();
      boxes_[slot] = b;
    }
    order_.push(slot);
  }

  InclusionResult stop(InclusionResult::End end, const Box& b) {
    result_.end = end;
    // Corners are halved exactly but for their bound, times are rounded by u / 2 each: by 25u in 50 halvings,
    // more than 2^-48 is never lost (docs/theory.md, T3).
    result_.t = std::max(in_.t_begin, b.t0 - kLateness);
    double nearest = INFINITY;
    for (int k = 0; k < per_end_; ++k) {
      double squares = 0, most = 0;
      for (int a = 0; a < 3; ++a) {
        const double x = std::fabs(b.f[k][a]) + b.error[a];
        squares += x * x;
        most = std::max(most, x);
      }
      nearest = std::min(nearest, in_.maximum_norm ? most : std::sqrt(squares));
    }
    result_.distance = (nearest + 2 * kLateness * in_.corners.rho) * (1 + 0x1p-48);
    return result_;
  }

  struct Later {
    const std::vector<Box>& boxes;
    bool operator()(int i, int j) const {
      const Box &a = boxes[std::size_t(i)], &b = boxes[std::size_t(j)];
      if (a.t0 != b.t0) return a.t0 > b.t0;
      if (a.depth != b.depth) return a.depth < b.depth;
      return i < j;
    }
  };

  const InclusionInput& in_;
  const int per_end_;
  std::vector<Box> boxes_;
  std::vector<int> free_;
  std::priority_queue<int, std::vector<int>, Later> order_{Later{boxes_}};
  InclusionResult result_;
};

}  // namespace

InclusionResult find_first_inclusion(const InclusionInput& input) { return Search(input).run(); }

}  // namespace onset
