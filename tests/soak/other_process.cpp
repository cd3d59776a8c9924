#include "tests/soak/other_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

extern char** environ;

namespace onset::tests {

bool read_all(int file, void* bytes, std::size_t count) {
  for (char* at = static_cast<char*>(bytes); count > 0;) {
    const ssize_t n = read(file, at, count);
    if (n <= 0) return false;
    at += n, count -= std::size_t(n);
  }
  return true;
}

bool write_all(int file, const void* bytes, std::size_t count) {
  for (const char* at = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t n = write(file, at, count);
    if (n <= 0) return false;
    at += n, count -= std::size_t(n);
  }
  return true;
}

OtherProcess::OtherProcess(const std::vector<const char*>& arguments) {
  std::signal(SIGPIPE, SIG_IGN);
  int in[2], out[2];
  if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  std::vector<char*> argv{const_cast<char*>("soak")};
  for (const char* a : arguments) argv.push_back(const_cast<char*>(a));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  const int failed = posix_spawn(&pid_, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(in[0]), close(out[1]);
  to_ = in[1], from_ = out[0];
  if (failed != 0) throw std::runtime_error("no other process");
}

OtherProcess::~OtherProcess() {
  close(to_), close(from_);
  if (pid_ > 0) waitpid(pid_, nullptr, 0);
}

bool OtherProcess::tell(const void* bytes, std::size_t count) { return write_all(to_, bytes, count); }
bool OtherProcess::hear(void* bytes, std::size_t count) { return read_all(from_, bytes, count); }

}  // namespace onset::tests
