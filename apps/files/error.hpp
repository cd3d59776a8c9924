// Bad input: the message is one line that names the cause.
#pragma once

#include <stdexcept>
#include <string>

namespace app {

struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Options that parse but cannot go together or are out of range.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace app
