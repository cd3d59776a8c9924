// Code that ends its process is run in a child.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tests/catch.hpp"

namespace onset::tests {

// Runs f in a child process and returns its status, or -1 where it did not end by itself.
template <class F>
int in_child_process(F&& f) {
  std::fflush(nullptr);  // or the child would print it again
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    alarm(60);  // a hanging child must not hang the test
    std::exit(f());
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace onset::tests
