// Without a contact at t = 0 the first one is on the boundary of {U a + V b} (docs/theory.md, L41): for a
// segment, w x e = 0 and h = w.(e - w) >= 0. It is a root of one of these quadratics, at which the others are
// alpha + beta sqrt(d) up to a factor.
//
// For coordinates of q, a, b below 2^c coefficients are below 2^m, m = 2c + 7, and a root is (u + v sqrt(d))
// / w with |u|, |w| < 2^(m + 1), d < 5 * 2^(2m) (§15.5).
#include "narrowphase/exact/coplanar.hpp"

namespace onset {
namespace {

// Limbs for a coefficient and products of two, three and six, and the bits that these take.
template <int N1, int N2, int N3, int N6>
struct Coplanar {
  using Coefficient = Wide<N1>;  // m + 3: sums of three
  using Product = Wide<N2>;      // 2m + 5: u^2 + d
  using Alpha = Wide<N3>;        // 3m + 6
  using Compared = Wide<N6>;     // 6m + 11
  static constexpr bool fits(int c) {
    return 6 * (2 * c + 7) + 11 <= 64 * N6 && 3 * (2 * c + 7) + 6 <= 64 * N3 &&
           2 * (2 * c + 7) + 5 <= 64 * N2 && 2 * c + 10 <= 64 * N1;
  }

  // a + b t + c t^2.
  struct Quadratic {
    Coefficient a, b, c;
    bool is_zero() const { return sign_of(a) == 0 && sign_of(b) == 0 && sign_of(c) == 0; }
    friend Quadratic operator+(const Quadratic& x, const Quadratic& y) {
      return {x.a + y.a, x.b + y.b, x.c + y.c};
    }
    friend Quadratic operator-(const Quadratic& x, const Quadratic& y) {
      return {x.a - y.a, x.b - y.b, x.c - y.c};
    }
  };

  struct Linear {
    Coefficient start, rate;
    friend Quadratic operator*(const Linear& x, const Linear& y) {
      return {x.start * y.start, x.start * y.rate + x.rate * y.start, x.rate * y.rate};
    }
  };
  using LinearVector = std::array<Linear, 3>;

  static LinearVector between(const std::array<Coefficient, 3>& start,
                              const std::array<Coefficient, 3>& end) {
    LinearVector r;
    for (int i = 0; i < 3; ++i) r[i] = {start[i], end[i] - start[i]};
    return r;
  }

  // Returns g's sign in (0, 1]; 0: not certain.
  static int definite_sign(const Quadratic& g) {
    const Coefficient twice = g.a + g.a;
    const int first = sign_of(g.a), middle = sign_of(twice + g.b), last = sign_of(g.a + g.b + g.c);
    return last != 0 && first * last >= 0 && middle * last >= 0 ? last : 0;
  }

  // (u + v sqrt(d)) / w, w > 0, v one of -1, 0, 1.
  struct Root {
    Coefficient u, w;
    int v = 0;
    Product d = 0;
  };

  // Finds the roots in increasing order.
  static int roots_of(const Quadratic& p, Root (&out)[2]) {
    if (sign_of(p.c) == 0) {
      const int s = sign_of(p.b);
      if (s == 0) return 0;
      out[0] = s > 0 ? Root{-p.a, p.b} : Root{p.a, -p.b};
      return 1;
    }
    const Product d = Product(p.b) * Product(p.b) - shifted(Product(p.a) * Product(p.c), 2);
    const int s = sign_of(d);
    if (s < 0) return 0;
    const Coefficient w = p.c + p.c;
    const Root middle = sign_of(p.c) > 0 ? Root{-p.b, w} : Root{p.b, -w};
    out[0] = out[1] = middle;
    if (s == 0) return 1;
    out[0].v = -1, out[1].v = 1;
    out[0].d = out[1].d = d;
    return 2;
  }

  // As |alpha| < 12 * 2^(3m) and |beta| < 4 * 2^(2m), alpha^2 and beta^2 d are below 2^(6m + 10).
  static int sign_of_sum(const Alpha& alpha, const Alpha& beta, const Product& d) {
    const int a = sign_of(alpha), b = sign_of(d) == 0 ? 0 : sign_of(beta);
    if (a == 0 || b == 0 || a == b) return a != 0 ? a : b;
    // Both are right to 2^-45.
    const double size = std::fabs(estimate(alpha)),
                 other = std::fabs(estimate(beta)) * std::sqrt(estimate(d));
    if (std::fabs(size - other) > 0x1p-40 * size) return size > other ? a : b;
    const Compared x = alpha, y = beta;
    return a * sign_of(x * x - y * y * Compared(d));
  }

  // Returns the sign of w^2 g at the root.
  static int sign_at(const Quadratic& g, const Root& r) {
    const Product u = r.u, w = r.w;
    const Product squares = r.v == 0 ? u * u : u * u + r.d;
    const Alpha alpha = Alpha(g.a) * Alpha(w * w) + Alpha(g.b) * Alpha(w * u) + Alpha(g.c) * Alpha(squares);
    if (r.v == 0) return sign_of(alpha);
    const Product half = Product(g.c) * u, beta = Product(g.b) * w + half + half;
    return sign_of_sum(alpha, r.v > 0 ? beta : -beta, r.d);
  }

  // The sign of w (t - root). For t = k / 2^e, |alpha| < 2^(m + 2 + e) and |beta| = 2^e: e < m fits.
  struct TimeAgainstRoot {
    const Root& root;
    bool fits = true;

    int at(double t) {
      const Dyadic time = to_dyadic(t);
      if (time.exponent >= 64 * N1 - 62) {
        fits = false;
        return 1;
      }
      const Alpha alpha = Alpha(root.w) * Alpha(time.numerator) - shifted(Alpha(root.u), time.exponent);
      const Alpha beta = shifted(Alpha(std::int64_t(-root.v)), time.exponent);
      return sign_of_sum(alpha, beta, root.d);
    }
  };

  // Approximates the root without cancellation.
  static double approximately(const Root& r) {
    const double u = estimate(r.u), w = estimate(r.w), s = r.v * std::sqrt(estimate(r.d));
    if (u * s >= 0) return (u + s) / w;
    return estimate(Product(r.u) * Product(r.u) - r.d) / (w * (u - s));
  }

  struct Segment {
    Quadratic off_line[3], extent;  // w x e and h

    Segment(const PointAndSegment<Coefficient>& s0, const PointAndSegment<Coefficient>& s1) {
      const LinearVector w = between(s0.w, s1.w), e = between(s0.e, s1.e),
                         rest = between(difference(s0.e, s0.w), difference(s1.e, s1.w));
      for (int k = 0; k < 3; ++k) {
        const std::size_t i = std::size_t(k + 1) % 3, j = std::size_t(k + 2) % 3;
        off_line[k] = w[i] * e[j] - w[j] * e[i];
      }
      extent = w[0] * rest[0] + w[1] * rest[1] + w[2] * rest[2];
    }

    // Finds the first time in (0, 1] at which the point is on the segment; it is not at t = 0.
    CoplanarContact first(bool adjacent) const {
      if (definite_sign(extent) < 0) return {};
      const Quadratic* moving = nullptr;
      for (const Quadratic& g : off_line) {
        if (g.is_zero()) continue;
        if (definite_sign(g) != 0) return {};
        moving = &g;
      }
      // Collinear for all t: then h, negative at first, reaches zero.
      Root roots[2];
      const int count = roots_of(moving ? *moving : extent, roots);
      for (int i = 0; i < count; ++i) {
        TimeAgainstRoot time{roots[i]};
        if (time.at(0) >= 0) continue;
        const int at_end = time.at(1);
        if (at_end < 0) return {};
        if (moving && !touches_at(roots[i])) continue;
        if (at_end == 0) return {Answer::yes, {1, 1}};
        const double guess = approximately(roots[i]);
        if (const DoubleBracket wide{guess * (1 - 0x1p-30), std::min(guess * (1 + 0x1p-30), 1.0)};
            !adjacent && time.at(wide.lo) < 0 && time.at(wide.hi) > 0 && time.fits)
          return {Answer::yes, wide};
        const DoubleBracket found = adjacent_doubles(0, 1, guess, [&](double t) { return -time.at(t); });
        return {time.fits ? Answer::yes : Answer::unknown, found};
      }
      return {};
    }

   private:
    bool touches_at(const Root& root) const {
      for (const Quadratic& g : off_line)
        if (sign_at(g, root) != 0) return false;
      return sign_at(extent, root) >= 0;
    }
  };

  template <class C>
  static RelativeVectors<Coefficient> widened(const RelativeVectors<C>& r) {
    const auto wide = [](const std::array<C, 3>& v) { return std::array<Coefficient, 3>{v[0], v[1], v[2]}; };
    return {wide(r.q), wide(r.a), wide(r.b)};
  }

  template <class C>
  static CoplanarContact first_contact(PairKind kind, const RelativeVectors<C>& r0,
                                       const RelativeVectors<C>& r1, bool adjacent) {
    PointAndSegment<Coefficient> start[4], end[4];
    const int count = boundary_of(kind, widened(r0), start);
    boundary_of(kind, widened(r1), end);
    CoplanarContact first;
    for (int i = 0; i < count; ++i) {
      const CoplanarContact here = Segment(start[i], end[i]).first(adjacent);
      if (here.answer == Answer::unknown) return here;
      if (here.answer == Answer::no) continue;
      // Rounding is monotonic: the ends of the earliest are the smallest ends.
      first = first.answer == Answer::no ? here
                                         : CoplanarContact{Answer::yes,
                                                           {std::min(first.time.lo, here.time.lo),
                                                            std::min(first.time.hi, here.time.hi)}};
    }
    return first;
  }
};

}  // namespace

CoplanarContact first_coplanar_contact(PairKind kind, const RelativeVectors<std::int64_t>& r0,
                                       const RelativeVectors<std::int64_t>& r1, bool adjacent) {
  using Narrow = Coplanar<3, 5, 7, 13>;
  static_assert(Narrow::fits(62), "");
  return Narrow::first_contact(kind, r0, r1, adjacent);
}
CoplanarContact first_coplanar_contact(PairKind kind, const RelativeVectors<Wide<2>>& r0,
                                       const RelativeVectors<Wide<2>>& r1, bool adjacent) {
  using Broad = Coplanar<4, 8, 12, 24>;
  static_assert(Broad::fits(121), "");
  return Broad::first_contact(kind, r0, r1, adjacent);
}

}  // namespace onset
