// Frames, lines of JSON, and a bar that shows how far the run is.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "cloth/stepper.hpp"

namespace cloth {

// Binary PLY, doubles. Throws app::InputError naming a file that cannot be written.
void write_frame(const std::string& path, const Vector& x, const std::vector<std::array<int, 3>>& faces);

std::string json_line(int step, const StepReport& report);

// On stderr, where that is a terminal.
class Bar {
 public:
  explicit Bar(int steps);
  ~Bar();
  void show(int done) const;

 private:
  int steps_;
  bool shown_;
};

}  // namespace cloth
