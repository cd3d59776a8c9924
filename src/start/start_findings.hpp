// The lists of a start report in words.
#pragma once

#include "onset/check.hpp"

namespace onset {

std::vector<StartFinding> start_findings(const Mesh& mesh, const StartReport& report);

}  // namespace onset
