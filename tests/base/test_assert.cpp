// A failed assertion says what failed and where, and ends the process.
#include <csignal>

#include "base/assert.hpp"
#include "tests/base/child_process.hpp"
#include "tests/catch.hpp"

using onset::tests::in_child_process;

TEST_CASE("a failed assertion is written to stderr and aborts", "[unit]") {
  int channel[2];
  REQUIRE(pipe(channel) == 0);
  const int status = in_child_process([&] {
    dup2(channel[1], STDERR_FILENO);
    std::signal(SIGABRT, [](int) { std::exit(6); });
    onset::assertion_failed("a < b", "file.cpp", 12);
    return 0;
  });
  close(channel[1]);
  char text[200] = {};
  CHECK(read(channel[0], text, sizeof text - 1) > 0);
  close(channel[0]);
  CHECK(std::string(text) == "onset: assertion failed: a < b (file.cpp:12)\n");
  CHECK(status == 6);
}
