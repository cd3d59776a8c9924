#include "measure/system.hpp"

#include <fstream>
#include <onset/onset.hpp>
#include <string>
#include <thread>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace app {
namespace {

// A line of /proc/self/status, "VmHWM:   1234 kB", in bytes; -1 without it.
std::int64_t status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == name + ":") {
      std::int64_t kilobytes = 0;
      return status >> kilobytes ? 1024 * kilobytes : -1;
    }
  return -1;
}

// Sets the peak to what is resident now.
bool reset_peak() {
  std::ofstream clear("/proc/self/clear_refs");
  return bool(clear << "5" << std::flush);
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

// The value of the first line "model name : ..." of /proc/cpuinfo.
std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != line.npos) return line.substr(colon + 2);
  }
  return "a CPU that does not tell its name";
}

std::string kernel() {
  const Eigen::MatrixXd x = Eigen::MatrixXd::Identity(3, 3);
  const onset::Mesh mesh(x, (Eigen::MatrixXi(1, 3) << 0, 1, 2).finished());
  return onset::construct_active_set(mesh, x, x).stats.instruction_set;
}

}  // namespace

std::optional<std::int64_t> peak_bytes(const std::function<void()>& work) {
  return_freed_memory();
  const bool can_tell = reset_peak();
  const std::int64_t before = status_bytes("VmRSS");
  work();
  const std::int64_t peak = status_bytes("VmHWM");
  if (!can_tell || before < 0 || peak < before) return std::nullopt;
  return peak - before;
}

std::string machine() {
  const unsigned cores = std::thread::hardware_concurrency();
  return cpu_model() + ", " + std::to_string(cores) + (cores == 1 ? " core" : " cores") + ", onset kernel " +
         kernel();
}

}  // namespace app
