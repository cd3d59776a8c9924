// Decimal rationals to the double that they stand for.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace app {

// In lowest terms no double has a numerator of more than 309 digits, or a denominator of more than 324;
// common factors may add to that. To find them costs the square of the length, at this limit less than a
// millisecond.
constexpr std::size_t kMostDigits = 10'000;

// numerator / denominator, each an optional sign and decimal digits, kMostDigits at most. Throws InputError
// (without a place) for anything else, a zero denominator, and a quotient that is not exactly a double.
double exact_double(std::string_view numerator, std::string_view denominator);

// "numerator,denominator" of a finite double, exactly.
std::string exact_rational(double value);

}  // namespace app
