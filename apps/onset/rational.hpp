// Decimal rationals of any length to the double that they stand for.
#pragma once

#include <string_view>

namespace app {

// numerator / denominator, each an optional sign and decimal digits. Throws InputError (without a place) for
// anything else, a zero denominator, and a quotient that is not exactly a double.
double exact_double(std::string_view numerator, std::string_view denominator);

}  // namespace app
