// The exact number types of the oracle, and how doubles go in and out.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#ifdef ONSET_ORACLE_GMP
#include <boost/multiprecision/gmp.hpp>
#endif

namespace onset::oracle {

// Header only, about ten times slower than GMP.
using PortableRational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
#ifdef ONSET_ORACLE_GMP
using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
#else
using Rational = PortableRational;
#endif

template <class Q>
int sign(const Q& x) {
  return x.sign();
}

// The largest double <= x and the smallest double >= x, for |x| below the largest double. Whatever the
// conversion rounds to, the comparisons are exact.
template <class Q>
double round_down(const Q& x) {
  double d = static_cast<double>(x);
  while (Q(d) > x) d = std::nextafter(d, -INFINITY);
  for (double next; Q(next = std::nextafter(d, INFINITY)) <= x;) d = next;
  return d;
}
template <class Q>
double round_up(const Q& x) {
  return -round_down<Q>(-x);
}

}  // namespace onset::oracle
