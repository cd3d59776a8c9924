// Calls on a step: both ends, options, and the interpreter's lock given to others meanwhile.
#pragma once

#include <onset/mesh.hpp>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/options.hpp"

namespace onset_python {

// call(mesh, x_t0, x_t1, options). The mesh is a copy: rules that are set meanwhile are for later calls.
template <class Call, class O = onset::Options>
auto on_step(const onset::Mesh& mesh, nb::handle x_t0, nb::handle x_t1, const nb::kwargs& named,
             const Call& call, O (*read)(const nb::kwargs&) = &options_of) {
  const PositionsArgument x0("x_t0", x_t0), x1("x_t1", x_t1);
  const O options = read(named);
  return without_lock([&, mesh] { return call(mesh, x0, x1, options); });
}

}  // namespace onset_python
