#include "files/queries/rational.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

#include "files/error.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

using boost::multiprecision::cpp_int;

struct Decimal {
  bool negative = false;
  std::string_view digits;  // at least one, no leading zeros but for "0"
};

Decimal parse(std::string_view text) {
  Decimal value;
  const std::string_view whole = text;
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) {
    value.negative = text[0] == '-';
    text.remove_prefix(1);
  }
  if (text.empty() || text.find_first_not_of("0123456789") != text.npos)
    throw InputError(quoted(whole) + " is not an integer");
  const std::size_t first = text.find_first_not_of('0');
  value.digits = first == text.npos ? "0" : text.substr(first);
  if (value.digits.size() > kMostDigits)
    throw InputError(quoted(whole) + " has " + std::to_string(value.digits.size()) + " digits, " +
                     std::to_string(kMostDigits) + " are read: cancel common factors");
  return value;
}

std::string shown(std::string_view numerator, std::string_view denominator) {
  const auto cut = [](std::string_view s) {
    return s.size() <= 24 ? std::string(s)
                          : std::string(s.substr(0, 20)) + "... (" + std::to_string(s.size()) + " digits)";
  };
  return cut(numerator) + "/" + cut(denominator);
}

// The quotient of two positive integers, NaN when it is not a double: odd * 2^exponent with an odd part of 53
// bits and an exponent in the range of (subnormal) doubles, once the common factor is gone.
double quotient(cpp_int n, cpp_int d) {
  const std::ptrdiff_t n_twos = lsb(n), d_twos = lsb(d);
  n >>= n_twos, d >>= d_twos;
  if (d != 1) {
    if (n % d != 0) return NAN;
    n /= d;
  }
  const std::ptrdiff_t bits = msb(n) + 1, exponent = n_twos - d_twos;
  if (bits > 53 || exponent < -1074 || exponent + bits > 1024) return NAN;
  return std::ldexp(double(std::uint64_t(n)), int(exponent));
}

// Most files: both parts below 2^53 and a power of two below, so that one division is exact.
bool small_quotient(const Decimal& n, const Decimal& d, double& value) {
  constexpr std::size_t kDigits = 15;
  if (n.digits.size() > kDigits || d.digits.size() > kDigits) return false;
  std::uint64_t a = 0, b = 0;
  std::from_chars(n.digits.data(), n.digits.data() + n.digits.size(), a);
  std::from_chars(d.digits.data(), d.digits.data() + d.digits.size(), b);
  if (b == 0 || (b & (b - 1)) != 0) return false;
  value = double(a) / double(b);
  return true;
}

}  // namespace

double exact_double(std::string_view numerator, std::string_view denominator) {
  const Decimal n = parse(numerator), d = parse(denominator);
  if (d.digits == "0") throw InputError("zero denominator in " + shown(numerator, denominator));
  double magnitude = 0;
  if (!small_quotient(n, d, magnitude) && n.digits != "0")
    magnitude = quotient(cpp_int(std::string(n.digits)), cpp_int(std::string(d.digits)));
  if (std::isnan(magnitude)) throw InputError(shown(numerator, denominator) + " is not exactly a double");
  if (magnitude == 0) return 0;  // a rational has one zero
  return n.negative != d.negative ? -magnitude : magnitude;
}

std::string exact_rational(double value) {
  if (value == 0) return "0,1";
  int exponent = 0;
  const double part = std::frexp(std::fabs(value), &exponent);
  cpp_int n = std::uint64_t(std::ldexp(part, 53)), d = 1;
  exponent -= 53;
  const unsigned twos = exponent < 0 ? std::min(unsigned(-exponent), unsigned(lsb(n))) : 0;
  n >>= twos;
  if (exponent < 0)
    d <<= unsigned(-exponent) - twos;
  else
    n <<= unsigned(exponent);
  return (value < 0 ? "-" : "") + n.str() + "," + d.str();
}

}  // namespace app
