// Another process of this program, that does what it is told, one thing at a time.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace onset::tests {

class OtherProcess {
 public:
  // Begins this program anew with these arguments. Its standard input and output are what `tell` writes and
  // `hear` reads.
  explicit OtherProcess(const std::vector<const char*>& arguments);
  // Closes its input, and waits until it has ended.
  ~OtherProcess();
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;
  // Return false where the other has ended.
  bool tell(const void* bytes, std::size_t count);
  bool hear(void* bytes, std::size_t count);

 private:
  int to_ = -1, from_ = -1;
  pid_t pid_ = -1;
};

// All of them, or false.
bool read_all(int file, void* bytes, std::size_t count);
bool write_all(int file, const void* bytes, std::size_t count);

}  // namespace onset::tests
