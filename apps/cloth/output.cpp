#include "cloth/output.hpp"

#include <nlohmann/json.hpp>

namespace cloth {

std::string json_line(int step, const StepReport& r) {
  const nlohmann::ordered_json line = {{"step", step},
                                       {"toi", r.toi},
                                       {"smallest_step", r.smallest_step},
                                       {"contacts", r.contacts},
                                       {"closest", r.closest},
                                       {"iterations", r.iterations},
                                       {"converged", r.converged},
                                       {"behind", r.behind},
                                       {"seconds_collision", r.seconds_collision},
                                       {"seconds", r.seconds}};
  return line.dump();
}

}  // namespace cloth
