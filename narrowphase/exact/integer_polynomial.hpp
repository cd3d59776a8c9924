// Polynomials with integer coefficients of any size, and exact signs at their roots (docs/theory.md, §15.4).
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <vector>

namespace onset {

using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

inline int sign_of(const Integer& x) { return x.sign(); }

class IntegerPolynomial {
 public:
  IntegerPolynomial() = default;  // zero
  explicit IntegerPolynomial(std::vector<Integer> coefficients) : c_(std::move(coefficients)) { trim(); }

  int degree() const { return int(c_.size()) - 1; }  // -1: zero
  bool is_zero() const { return c_.empty(); }
  const Integer& operator[](int i) const { return c_[std::size_t(i)]; }
  const Integer& leading() const { return c_.back(); }

  friend IntegerPolynomial operator+(const IntegerPolynomial& a, const IntegerPolynomial& b);
  friend IntegerPolynomial operator-(const IntegerPolynomial& a, const IntegerPolynomial& b);
  friend IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b);

 private:
  void trim();
  std::vector<Integer> c_;  // constant term first, no leading zeros
};

IntegerPolynomial greatest_common_divisor(IntegerPolynomial a, IntegerPolynomial b);
// Returns a polynomial with the same roots, each once; p != 0.
IntegerPolynomial square_free(const IntegerPolynomial& p);
// Returns the sign of p at numerator / 2^exponent.
int sign_at(const IntegerPolynomial& p, const Integer& numerator, unsigned exponent);

// A root of the square-free p: at k / 2^depth (exact), or the only one inside [k, k + 1] / 2^depth.
struct IsolatedRoot {
  IntegerPolynomial p;
  Integer k;
  unsigned depth = 0;
  bool exact = false;
};
// Returns where in its interval the root lies, from 0 to 1, roughly; degree <= 3.
double position_in_interval(const IsolatedRoot& root);
// Finds the roots of f != 0 in [0, 1], in increasing order.
std::vector<IsolatedRoot> isolated_roots(const IntegerPolynomial& f);
// Returns the sign of g at the root, whose interval may narrow. It always ends: common divisors tell zero.
int sign_at(const IntegerPolynomial& g, IsolatedRoot& root);

}  // namespace onset
