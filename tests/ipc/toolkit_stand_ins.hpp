// What ipc-toolkit's sources include and its Python package does not ship, as far as toolkit_plugin.py has
// them compiled: a configuration, a logger that says nothing, one function of libigl, and declarations of
// what is never called.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <stdexcept>
#include <string>

#define IPC_TOOLKIT_NAME "ipc_toolkit"

namespace ipc {

using index_t = std::int32_t;
inline constexpr int VERTEX_DERIVATIVE_LAYOUT = Eigen::RowMajor;

struct SilentLogger {
  template <class... Values>
  void trace(const Values&...) {}
  template <class... Values>
  void debug(const Values&...) {}
  template <class... Values>
  void info(const Values&...) {}
  template <class... Values>
  void warn(const Values&...) {}
  template <class... Values>
  void error(const Values&...) {}
};
inline SilentLogger& logger() {
  static SilentLogger silent;
  return silent;
}
template <class... Values>
[[noreturn]] void log_and_throw_error(const std::string& message, const Values&...) {
  throw std::runtime_error(message);
}

}  // namespace ipc

namespace fmt {
template <class... Values>
std::string format(const std::string& text, const Values&...) {
  return text;
}
}  // namespace fmt

namespace ticcd {  // of the default narrow phase, which nobody is to ask
template <class... Values>
bool edgeEdgeCCD(const Values&...) {
  throw std::logic_error("Tight Inclusion is not here");
}
template <class... Values>
bool vertexFaceCCD(const Values&...) {
  throw std::logic_error("Tight Inclusion is not here");
}
}  // namespace ticcd

namespace igl {

// The rows of V that F uses, in their order: NV; F by those: NF; old rows to new, -1 where there is none: I;
// new to old: J.
template <class V, class F>
void remove_unreferenced(const V& vertices, const F& faces, Eigen::MatrixXd& NV, Eigen::MatrixXi& NF,
                         Eigen::VectorXi& I, Eigen::VectorXi& J) {
  I = Eigen::VectorXi::Constant(vertices.rows(), -1);
  for (const int v : faces.reshaped()) I[v] = 0;
  int count = 0;
  for (int& i : I)
    if (i == 0) i = count++;
  J.resize(count);
  NV.resize(count, vertices.cols());
  for (int v = 0; v < I.size(); ++v)
    if (I[v] >= 0) J[I[v]] = v, NV.row(I[v]) = vertices.row(v);
  NF = faces;
  for (int& v : NF.reshaped()) v = I[v];
}

namespace predicates {
inline void exactinit() {}
template <class... Values>
bool segment_segment_intersect(const Values&...) {
  throw std::logic_error("predicates are not here");
}
}  // namespace predicates

}  // namespace igl
