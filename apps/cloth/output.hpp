// Lines of JSON.
#pragma once

#include <string>

#include "cloth/stepper.hpp"

namespace cloth {

std::string json_line(int step, const StepReport& report);

}  // namespace cloth
