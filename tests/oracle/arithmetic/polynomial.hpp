// Polynomials in one variable over an exact field Q.
#pragma once

#include <utility>
#include <vector>

namespace onset::oracle {

template <class Q>
class Polynomial {
 public:
  Polynomial() = default;  // zero
  // Coefficients, constant term first.
  explicit Polynomial(std::vector<Q> coefficients) : c_(std::move(coefficients)) { trim(); }
  // x0 at t = 0, x1 at t = 1.
  static Polynomial linear(const Q& x0, const Q& x1) { return Polynomial({x0, x1 - x0}); }

  int degree() const { return int(c_.size()) - 1; }  // -1: zero
  bool is_zero() const { return c_.empty(); }
  const Q& operator[](int i) const { return c_[std::size_t(i)]; }
  const Q& leading() const { return c_.back(); }

  Q value(const Q& t) const {
    Q sum = 0;
    for (int i = degree(); i >= 0; --i) sum = sum * t + (*this)[i];
    return sum;
  }

  friend Polynomial operator+(Polynomial a, const Polynomial& b) {
    if (b.c_.size() > a.c_.size()) a.c_.resize(b.c_.size(), Q(0));
    for (std::size_t i = 0; i < b.c_.size(); ++i) a.c_[i] += b.c_[i];
    a.trim();
    return a;
  }
  friend Polynomial operator-(Polynomial a) {
    for (Q& x : a.c_) x = -x;
    return a;
  }
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + -b; }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    if (a.is_zero() || b.is_zero()) return {};
    std::vector<Q> c(a.c_.size() + b.c_.size() - 1, Q(0));
    for (std::size_t i = 0; i < a.c_.size(); ++i)
      for (std::size_t j = 0; j < b.c_.size(); ++j) c[i + j] += a.c_[i] * b.c_[j];
    return Polynomial(std::move(c));
  }

 private:
  void trim() {
    while (!c_.empty() && c_.back() == 0) c_.pop_back();
  }
  std::vector<Q> c_;  // no leading zeros
};

template <class Q>
Polynomial<Q> derivative(const Polynomial<Q>& p) {
  std::vector<Q> c;
  for (int i = 1; i <= p.degree(); ++i) c.push_back(p[i] * i);
  return Polynomial<Q>(std::move(c));
}

// Euclidean division by d != 0.
template <class Q>
struct Division {
  Polynomial<Q> quotient, remainder;
};
template <class Q>
Division<Q> divide(const Polynomial<Q>& p, const Polynomial<Q>& d) {
  std::vector<Q> rest, quotient(std::size_t(std::max(0, p.degree() - d.degree() + 1)), Q(0));
  for (int i = 0; i <= p.degree(); ++i) rest.push_back(p[i]);
  for (int shift = p.degree() - d.degree(); shift >= 0; --shift) {
    const Q factor = rest[std::size_t(shift + d.degree())] / d.leading();
    quotient[std::size_t(shift)] = factor;
    for (int i = 0; i <= d.degree(); ++i) rest[std::size_t(shift + i)] -= factor * d[i];
  }
  return {Polynomial<Q>(std::move(quotient)), Polynomial<Q>(std::move(rest))};
}
template <class Q>
Polynomial<Q> remainder(const Polynomial<Q>& p, const Polynomial<Q>& d) {
  return divide(p, d).remainder;
}

// Monic; zero only when both are zero.
template <class Q>
Polynomial<Q> gcd(Polynomial<Q> a, Polynomial<Q> b) {
  while (!b.is_zero()) {
    Polynomial<Q> r = remainder(a, b);
    a = std::move(b);
    b = std::move(r);
  }
  return a.is_zero() ? a : a * Polynomial<Q>({Q(1) / a.leading()});
}

// The same roots, each once. p != 0.
template <class Q>
Polynomial<Q> square_free(const Polynomial<Q>& p) {
  return divide(p, gcd(p, derivative(p))).quotient;
}

}  // namespace onset::oracle
