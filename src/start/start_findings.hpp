// A start report in words.
#pragma once

#include "onset/check.hpp"

namespace onset {

// Returns what the lists of a report say, a finding each.
std::vector<StartFinding> start_findings(const Mesh& mesh, const StartReport& report);

}  // namespace onset
