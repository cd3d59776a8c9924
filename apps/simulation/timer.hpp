// CPU seconds of all threads since it was made: what else the machine is busy with does not count.
#pragma once

#include "measure/timing.hpp"

namespace simulation {

class Timer {
 public:
  double seconds() const { return watch_.elapsed().cpu; }

 private:
  app::Stopwatch watch_;
};

}  // namespace simulation
