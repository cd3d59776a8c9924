// Decimal rationals of any length to the double that they stand for.
#pragma once

#include <string>
#include <string_view>

namespace app {

// numerator / denominator, each an optional sign and decimal digits. Throws InputError (without a place) for
// anything else, a zero denominator, and a quotient that is not exactly a double.
double exact_double(std::string_view numerator, std::string_view denominator);

// "numerator,denominator" of a finite double, exactly.
std::string exact_rational(double value);

}  // namespace app
