// Calls from the library back into Python, from any thread, until the interpreter ends.
#pragma once

#include <nanobind/nanobind.h>

namespace onset_python {

// Takes the interpreter's lock for one callback. While the interpreter ends a thread that wants the lock
// would be ended itself, in the midst of the library: after atexit no callback begins (false, or
// std::runtime_error where it has to), and those that run are waited for.
class Callback {
 public:
  Callback() noexcept;
  ~Callback();
  Callback(const Callback&) = delete;
  Callback& operator=(const Callback&) = delete;
  explicit operator bool() const noexcept { return begun_; }
  // Throws where the interpreter ends.
  void require() const;

 private:
  bool begun_;
  PyGILState_STATE state_{};
};

// Whether the interpreter ends, and not by this thread.
bool ends_elsewhere() noexcept;
// Registers with atexit.
void end_callbacks_at_exit();

// Gives the interpreter's lock to others as long as it lives. A thread that would take it back while the
// interpreter ends waits for the end of the process in its place.
class WithoutLock {
 public:
  WithoutLock() noexcept : state_(PyEval_SaveThread()) {}
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* state_;
};

}  // namespace onset_python
