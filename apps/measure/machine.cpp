#include "measure/machine.hpp"

#include <fstream>
#include <onset/onset.hpp>
#include <thread>

namespace app {
namespace {

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
  return onset::construct_active_set(mesh, x, x).stats.kernel;
}

}  // namespace

std::string machine() {
  const unsigned cores = std::thread::hardware_concurrency();
  return cpu_model() + ", " + std::to_string(cores) + (cores == 1 ? " core" : " cores") + ", onset kernel " +
         kernel();
}

}  // namespace app
