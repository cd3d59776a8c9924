// Bad input: the message is one line that names the cause.
#pragma once

#include <stdexcept>
#include <string>

namespace app {

// What the command line exits with.
enum ExitCode { kExitOk = 0, kExitBadInput = 1, kExitUsage = 2, kExitNotClean = 3 };

// Thrown when everything is written, and `check` has found something.
struct NotClean {};

struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Options that parse but cannot go together or are out of range.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace app
