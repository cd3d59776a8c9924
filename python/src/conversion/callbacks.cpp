#include "conversion/callbacks.hpp"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace onset_python {
namespace {

namespace nb = nanobind;

std::atomic<bool> ending{false};
std::atomic<unsigned long> ending_thread{0};
std::atomic<int> running{0};

// With the lock, which those that run may wait for. Longer than a second no callback may hold up the end.
void end_callbacks() {
  ending_thread = PyThread_get_thread_ident();
  ending = true;
  const nb::gil_scoped_release released;
  for (int i = 0; running > 0 && i < 1000; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

bool ends_elsewhere() noexcept { return ending && PyThread_get_thread_ident() != ending_thread; }

WithoutLock::~WithoutLock() {
  while (ends_elsewhere()) std::this_thread::sleep_for(std::chrono::hours(1));
  PyEval_RestoreThread(state_);
}

Callback::Callback() noexcept {
  ++running;  // before the look: the end waits for whoever has not seen it
  begun_ = !ends_elsewhere();
  if (begun_) state_ = PyGILState_Ensure();
}

Callback::~Callback() {
  if (begun_) PyGILState_Release(state_);
  --running;
}

void Callback::require() const {
  if (!begun_) throw std::runtime_error("the interpreter ends");
}

void end_callbacks_at_exit() {
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(&end_callbacks));
}

}  // namespace onset_python
