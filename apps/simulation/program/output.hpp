// Frames, and a bar that shows how far the run is.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "measure/timing.hpp"
#include "simulation/system.hpp"

namespace simulation {

// The path of a frame in `folder`: frame_0007.ply.
std::string frame_path(const std::string& folder, int step, const std::string& extension);

// Binary PLY, doubles. Throws app::InputError naming a file that cannot be written.
void write_ply_frame(const std::string& path, const Vector& x, const std::vector<std::array<int, 3>>& faces);

// On stderr, where that is a terminal: steps done, and about how long the others will take.
class Bar {
 public:
  explicit Bar(int steps);
  ~Bar();
  void show(int done) const;

 private:
  int steps_;
  bool shown_;
  app::Stopwatch timer_;
};

}  // namespace simulation
