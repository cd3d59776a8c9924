// How much memory is held at most while something runs, in programs with memory.cpp, where malloc is counted:
// not under sanitizers, which have limits of their own.
#pragma once

#include <cstddef>

namespace onset::fuzz {

class MemoryWatch {
 public:
  MemoryWatch();
  // Bytes beyond those held when it was made.
  std::size_t most() const;

 private:
  std::size_t before_;
};

}  // namespace onset::fuzz
