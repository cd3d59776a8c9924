// A program of others that tells how far a step may go, so that it can be compared with the library in the
// same simulation.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <onset/mesh.hpp>
#include <string>

#include "simulation/system.hpp"

namespace simulation {

// The command reads from its standard input, and answers on its standard output, raw little-endian numbers:
//
//   once          int64 #V, #E, #F; double rest positions, x y z of each vertex; int32 edges; int32 faces
//   each question double x_t0, then x_t1, x y z of each vertex
//   each answer   double step, in [0, 1]; double seconds that it took; int32 bytes of words, and the words:
//                 the pair that does not let the step begin, or nothing
//
// The seconds are its own, so that the way through the pipes does not count.
class CollisionServer {
 public:
  // The shell runs `command`. Throws std::runtime_error where that fails.
  CollisionServer(const std::string& command, const onset::Mesh& mesh, const Vector& rest);
  ~CollisionServer();
  CollisionServer(const CollisionServer&) = delete;
  CollisionServer& operator=(const CollisionServer&) = delete;

  struct Answer {
    double step = 0, seconds = 0;
    std::string pair;
  };
  // Throws std::runtime_error where the program ended, or answers what is no step.
  Answer ask(const Vector& x_t0, const Vector& x_t1);

 private:
  void write(const void* data, std::size_t size);
  void read(void* data, std::size_t size);
  [[noreturn]] void fail(const std::string& cause) const;

  std::string command_;
  pid_t process_ = -1;
  int to_ = -1, from_ = -1;
};

}  // namespace simulation
