#include "onset/result.hpp"

namespace onset {

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::free:
      return "free";
    case Outcome::contact:
      return "contact";
    case Outcome::initial_contact:
      return "initial_contact";
    case Outcome::initial_separating:
      return "initial_separating";
    case Outcome::max_checks:
      return "max_checks";
    case Outcome::below_rounding:
      return "below_rounding";
    case Outcome::non_finite:
      return "non_finite";
    case Outcome::out_of_range:
      return "out_of_range";
    case Outcome::out_of_time:
      return "out_of_time";
    case Outcome::out_of_memory:
      return "out_of_memory";
    case Outcome::out_of_checks:
      return "out_of_checks";
    case Outcome::cancelled:
      return "cancelled";
  }
  return "unknown";
}

const char* to_string(Certainty certainty) {
  switch (certainty) {
    case Certainty::within_tolerance:
      return "within_tolerance";
    case Certainty::certain:
      return "certain";
    case Certainty::touching_at_start:
      return "touching_at_start";
  }
  return "unknown";
}

std::ptrdiff_t ActiveSet::earliest() const {
  std::ptrdiff_t best = -1;
  for (std::size_t i = 0; i < toi.size(); ++i)
    if (best < 0 || toi[i] < toi[std::size_t(best)]) best = std::ptrdiff_t(i);
  return best;
}

}  // namespace onset
