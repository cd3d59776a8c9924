#include "onset/result.hpp"

#include "base/float_environment.hpp"
#include "onset/active_set.hpp"

namespace onset {

const char* to_string(PairKind kind) noexcept {
  switch (kind) {
    case PairKind::vertex_face:
      return "vertex_face";
    case PairKind::edge_edge:
      return "edge_edge";
    case PairKind::vertex_edge:
      return "vertex_edge";
    case PairKind::vertex_plane:
      return "vertex_plane";
  }
  return "unknown";
}

const char* to_string(PairOutcome outcome) noexcept {
  switch (outcome) {
    case PairOutcome::free:
      return "free";
    case PairOutcome::contact:
      return "contact";
    case PairOutcome::initial_contact:
      return "initial_contact";
    case PairOutcome::initial_separating:
      return "initial_separating";
    case PairOutcome::max_checks:
      return "max_checks";
    case PairOutcome::below_rounding:
      return "below_rounding";
    case PairOutcome::non_finite:
      return "non_finite";
    case PairOutcome::out_of_range:
      return "out_of_range";
  }
  return "unknown";
}

const char* to_string(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::free:
      return "free";
    case Outcome::contact:
      return "contact";
    case Outcome::initial_contact:
      return "initial_contact";
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

const char* to_string(Certainty certainty) noexcept {
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

const Contact* ActiveSet::earliest() const noexcept {
  const FloatEnvironment environment;
  const Contact* best = nullptr;
  for (const Contact& contact : contacts)
    if (best == nullptr || contact.toi < best->toi) best = &contact;
  return best;
}

}  // namespace onset
