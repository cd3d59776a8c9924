// The search for a pair's first contact in integers of fixed width, which decides all that is generic
// (docs/theory.md, §15.3).
//
// At a root of f(t) = q.(a x b), where N = (a x b)_k != 0, contact needs N's sign or 0 of U = (q x b)_k, V =
// (a x q)_k and N - U - V (vertex-face) or N - U, N - V (edge-edge) (L38). Bernstein coefficients are halved
// in time, multiplied by 8 (cubic) or 4 (quadratic) to stay integers, until their signs decide.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "narrowphase/exact/bracket.hpp"
#include "narrowphase/exact/common_root.hpp"
#include "narrowphase/exact/static.hpp"

namespace onset {

// The first contact is at k / 2^depth (exact), or at f's only root in the open interval [k, k + 1] / 2^depth,
// at whose ends f has opposite signs.
struct ContactInterval {
  Answer answer = Answer::unknown;
  std::uint64_t k = 0;
  int depth = 0;
  bool exact = false;
  // Unknown although f's root is known to the last bit: wider integers do not help.
  bool zoomed = false;
  // Unknown since f = 0 for all t, and no contact at t = 0.
  bool coplanar = false;
};

// N limbs hold f at a double, C the coordinates of q, a, b, below 2^c, M products of two, 2^(2c + 2), T f,
// 2^(3c + 5 + 3 depth).
template <int N, class C, class M, class T>
class ExactSearch {
 public:
  ExactSearch(PairKind kind, const RelativeVectors<C>& r0, const RelativeVectors<C>& r1, int cubic_bits,
              int max_depth)
      : kind_(kind), r0_(r0), r1_(r1), cubic_bits_(cubic_bits), max_depth_(max_depth) {}

  ContactInterval first() {
    const Normal n = set_cubic();
    if (sign_of(f_[0]) == 0 && coplanar_touch<M>(kind_, r0_)) return {Answer::yes, 0, 0, true};
    if (sign_of(f_[0]) == 0 && sign_of(f_[1]) == 0 && sign_of(f_[2]) == 0 && sign_of(f_[3]) == 0)
      return {Answer::unknown, 0, 0, false, false, true};
    if (has_no_root(f_)) return at_end();
    set_slot(n, whole_);
    const Answer inside = visit_all();
    if (inside == Answer::no) return at_end();
    found_.answer = inside;
    return found_;
  }
  const T (&cubic() const)[4] { return f_; }  // Bernstein coefficients, up to a factor > 0

 private:
  static constexpr int kZoom = 10;       // from this depth a single root is found to the last bit
  static constexpr int kQuadratics = 5;  // N, then what must have its sign
  struct Slot {
    T f[4];
    T g[kQuadratics][3];
    int sign;  // N's in the open interval, where it has one, or 0
    bool open[kQuadratics];
  };
  struct Normal {
    std::array<M, 3> n00, mixed, n11;
  };

  static std::array<M, 3> sum(const std::array<M, 3>& u, const std::array<M, 3>& v) {
    return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
  }
  static T dot(const std::array<C, 3>& u, const std::array<M, 3>& v) {
    return T(u[0]) * T(v[0]) + T(u[1]) * T(v[1]) + T(u[2]) * T(v[2]);
  }

  // Sets f_ to three times the Bernstein coefficients of f.
  Normal set_cubic() {
    const Normal n{exact_cross<M>(r0_.a, r0_.b),
                   sum(exact_cross<M>(r0_.a, r1_.b), exact_cross<M>(r1_.a, r0_.b)),
                   exact_cross<M>(r1_.a, r1_.b)};
    const T first = dot(r0_.q, n.n00), last = dot(r1_.q, n.n11);
    f_[0] = first + first + first;
    f_[1] = dot(r1_.q, n.n00) + dot(r0_.q, n.mixed);
    f_[2] = dot(r0_.q, n.n11) + dot(r1_.q, n.mixed);
    f_[3] = last + last + last;
    return n;
  }

  // Sets g to twice the Bernstein coefficients of component k of u x v.
  static void set_quadratic(int k, const std::array<C, 3> (&u)[2], const std::array<C, 3> (&v)[2],
                            T (&g)[3]) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const auto minor = [&](int s, int t) { return T(M(u[s][i]) * M(v[t][j]) - M(u[s][j]) * M(v[t][i])); };
    const T first = minor(0, 0), last = minor(1, 1);
    g[0] = first + first;
    g[1] = minor(0, 1) + minor(1, 0);
    g[2] = last + last;
  }

  static int widest_axis(const Normal& n) {
    int k = 0;
    double largest = -1;
    for (int i = 0; i < 3; ++i) {
      const double size = std::fabs(estimate(n.n00[i]) + estimate(n.mixed[i]) + estimate(n.n11[i]));
      if (size > largest) largest = size, k = i;
    }
    return k;
  }

  void set_slot(const Normal& n, Slot& s) const {
    const int k = widest_axis(n);
    const std::array<C, 3> q[2] = {r0_.q, r1_.q}, a[2] = {r0_.a, r1_.a}, b[2] = {r0_.b, r1_.b};
    for (int i = 0; i < 4; ++i) s.f[i] = f_[i];
    s.g[0][0] = T(n.n00[k]) + T(n.n00[k]);
    s.g[0][1] = T(n.mixed[k]);
    s.g[0][2] = T(n.n11[k]) + T(n.n11[k]);
    set_quadratic(k, q, b, s.g[1]);
    set_quadratic(k, a, q, s.g[2]);
    for (int i = 0; i < 3; ++i) {
      const T over = s.g[0][i] - s.g[1][i];
      s.g[3][i] = kind_ != PairKind::edge_edge ? over - s.g[2][i] : over;
      s.g[4][i] = s.g[0][i] - s.g[2][i];
    }
    s.sign = 0;
    for (bool& x : s.open) x = true;
    if (kind_ != PairKind::edge_edge) s.open[4] = false;
  }

  template <int D>
  static bool has_no_root(const T (&c)[D]) {
    return definite_sign(c) != 0;
  }
  // Returns the sign in the open interval; 0: not certain, or zero throughout.
  template <int D>
  static int definite_sign(const T (&c)[D]) {
    bool positive = false, negative = false;
    for (const T& x : c) {
      const int s = sign_of(x);
      positive |= s > 0;
      negative |= s < 0;
    }
    return positive == negative ? 0 : positive ? 1 : -1;
  }
  static bool is_zero(const T (&c)[3]) {
    return sign_of(c[0]) == 0 && sign_of(c[1]) == 0 && sign_of(c[2]) == 0;
  }

  // Tells, by Descartes, whether f has exactly one root in the open interval and is not zero at its ends.
  static bool has_one_root(const T (&f)[4]) {
    if (sign_of(f[0]) * sign_of(f[3]) >= 0) return false;
    int changes = 0, last = sign_of(f[0]);
    for (const T& x : f)
      if (const int s = sign_of(x); s != 0 && s != last) last = s, ++changes;
    return changes == 1;
  }

  // Closes what has N's sign throughout. True: something has the other, so there is no contact in the open
  // interval.
  bool outside(Slot& s) const {
    if (s.sign == 0) s.sign = definite_sign(s.g[0]);
    if (s.sign == 0) return false;
    s.open[0] = false;
    for (int i = 1; i < kQuadratics; ++i) {
      if (!s.open[i]) continue;
      const int sign = definite_sign(s.g[i]);
      if (sign == -s.sign) return true;
      if (sign == s.sign || is_zero(s.g[i])) s.open[i] = false;
    }
    return false;
  }
  static bool inside(const Slot& s) {
    for (const bool x : s.open)
      if (x) return false;
    return true;
  }

  // Decides the slot's first time, where f = 0.
  static Answer touches_at_start(const Slot& s) {
    const int sign = s.sign != 0 && !s.open[0] && sign_of(s.g[0][0]) != 0 ? s.sign : sign_of(s.g[0][0]);
    if (sign == 0) return Answer::unknown;
    for (int i = 1; i < kQuadratics; ++i)
      if (s.open[i] && sign * sign_of(s.g[i][0]) < 0) return Answer::no;
    return Answer::yes;
  }

  static void halve(const T (&c)[4], T (&l)[4], T (&r)[4]) {
    const T twice1 = c[1] + c[1], twice2 = c[2] + c[2], inner = c[1] + c[2];
    const T left = c[0] + twice1 + c[2], right = c[1] + twice2 + c[3];
    l[0] = shifted(c[0], 3), l[1] = shifted(c[0] + c[1], 2), l[2] = shifted(left, 1);
    l[3] = r[0] = c[0] + inner + inner + inner + c[3];
    r[1] = shifted(right, 1), r[2] = shifted(c[2] + c[3], 2), r[3] = shifted(c[3], 3);
  }
  static void halve(const T (&c)[3], T (&l)[3], T (&r)[3]) {
    const T left = c[0] + c[1], right = c[1] + c[2];
    l[0] = shifted(c[0], 2), l[1] = shifted(left, 1);
    l[2] = r[0] = left + right;
    r[1] = shifted(right, 1), r[2] = shifted(c[2], 2);
  }
  static void halve(const Slot& s, Slot& l, Slot& r) {
    halve(s.f, l.f, r.f);
    l.sign = r.sign = s.sign;
    for (int i = 0; i < kQuadratics; ++i) {
      l.open[i] = r.open[i] = s.open[i];
      if (i == 0 || s.open[i]) halve(s.g[i], l.g[i], r.g[i]);
    }
  }

  // The halves of an interval.
  struct Halves {
    Slot left, right;
  };

  // Decides intervals from left to right, and halves those that cannot be. No recursion: slots are large, and
  // a thread's stack may not be.
  Answer visit_all() {
    Slot whole = whole_, *s = &whole;
    std::unique_ptr<Halves[]> halves;  // of the interval at each depth, on the way to this one
    std::uint64_t k = 0;
    for (int depth = 0;;) {
      const std::optional<Answer> answer = decide(*s, k, depth);
      if (!answer) {
        if (!halves) halves.reset(new Halves[std::size_t(max_depth_)]);
        Halves& h = halves[std::size_t(depth)];
        halve(*s, h.left, h.right);
        s = &h.left;
        k = 2 * k, ++depth;
        continue;
      }
      if (*answer != Answer::no) return *answer;
      while (k % 2 == 1) k /= 2, --depth;
      if (depth == 0) return Answer::no;
      s = &halves[std::size_t(depth) - 1].right;
      ++k;
    }
  }

  // Decides the first time and the open interval of [k, k + 1] / 2^depth; none: its halves have to be.
  std::optional<Answer> decide(Slot& s, std::uint64_t k, int depth) {
    if (depth > 0 && sign_of(s.f[0]) == 0) {
      const Answer start = touches_at_start(s);
      if (start != Answer::no) {
        found_ = {start, k, depth, true};
        return start;
      }
    }
    if (has_no_root(s.f) || outside(s)) return Answer::no;
    if (inside(s) && has_one_root(s.f)) {
      found_ = {Answer::yes, k, depth};
      return Answer::yes;
    }
    if (s.sign != 0 && depth >= std::min(kZoom, max_depth_) && has_one_root(s.f)) {
      close_zeros(s, k, depth);
      return zoom(s, k, depth);
    }
    if (depth == max_depth_) return Answer::unknown;
    return std::nullopt;
  }

  // Closes what is zero at f's one root, which counts as inside.
  void close_zeros(Slot& s, std::uint64_t k, int depth) const {
    for (int i = 1; i < kQuadratics; ++i)
      if (s.open[i] && vanishes(whole_.g[i], k, depth, sign_of(s.g[i][0]) * sign_of(s.g[i][2]) < 0))
        s.open[i] = false;
  }
  // False: no, or too wide to know.
  bool vanishes(const T (&g)[3], std::uint64_t k, int depth, bool changes_sign) const {
    using Widths = std::conditional_t<sizeof(T) <= 32, NarrowCommonRoot, WideCommonRoot>;
    return Widths::fit((cubic_bits_ - 5) / 3) && vanishes_at_root(Widths(), f_, g, k, depth, changes_sign);
  }

  // Returns twice the polarised quadratic at x / 2^e, x' / 2^e, times 4^e.
  static Wide<N> polarised(const T (&g)[3], const Wide<N>& x, const Wide<N>& x1, const Wide<N>& one) {
    const Wide<N> y = one - x, y1 = one - x1;
    return Wide<N>(g[0]) * (y * y1) + Wide<N>(g[1]) * (x * y1 + x1 * y) + Wide<N>(g[2]) * (x * x1);
  }

  // Decides the rest between the adjacent doubles around f's one root, where N has a sign.
  Answer zoom(const Slot& s, std::uint64_t k, int depth) {
    if (inside(s)) {
      found_ = {Answer::yes, k, depth};
      return Answer::yes;
    }
    found_.zoomed = true;
    const auto t = bracket_of<N>(f_, cubic_bits_, k, depth);
    if (!t) return Answer::unknown;
    const Dyadic lo = to_dyadic(t->lo), hi = to_dyadic(t->hi);
    const int e = std::max(lo.exponent, hi.exponent);
    // Polarised quadratics are below 2^(2c + 2e + 8).
    if (cubic_bits_ + 2 * e + 4 > 64 * N) return Answer::unknown;
    const Wide<N> one = shifted(Wide<N>(1), e), x = shifted(Wide<N>(lo.numerator), e - lo.exponent),
                  x1 = shifted(Wide<N>(hi.numerator), e - hi.exponent);
    Answer answer = Answer::yes;
    for (int i = 1; i < kQuadratics; ++i) {
      if (!s.open[i]) continue;
      const int first = s.sign * sign_of(polarised(whole_.g[i], x, x, one));
      const int middle = s.sign * sign_of(polarised(whole_.g[i], x, x1, one));
      const int last = s.sign * sign_of(polarised(whole_.g[i], x1, x1, one));
      if (t->lo == t->hi ? first < 0 : first <= 0 && middle <= 0 && last <= 0 && (first | middle | last) != 0)
        return Answer::no;
      if (first < 0 || middle < 0 || last < 0) answer = Answer::unknown;
    }
    if (answer == Answer::yes) found_ = {answer, k, depth, false, true};
    return answer;
  }

  ContactInterval at_end() const {
    const bool touches = sign_of(f_[3]) == 0 && coplanar_touch<M>(kind_, r1_);
    return {touches ? Answer::yes : Answer::no, 1, 0, true};
  }

  PairKind kind_;
  RelativeVectors<C> r0_, r1_;
  int cubic_bits_, max_depth_;
  Slot whole_;
  T f_[4];
  ContactInterval found_;
};

}  // namespace onset
