// What each file of this folder adds to the module, in the order in which it is added.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "conversion/callbacks.hpp"
#include "conversion/docs.hpp"

namespace onset_python {

namespace nb = nanobind;

void bind_enums(nb::module_& m);
void bind_results(nb::module_& m);
void bind_rules(nb::module_& m);
void bind_mesh(nb::module_& m);
void bind_candidates(nb::module_& m);
void bind_close_pairs(nb::module_& m);
void bind_steps(nb::module_& m);
void bind_line_search(nb::module_& m);
void bind_active_sets(nb::module_& m);
void bind_maps(nb::module_& m);
void bind_starts(nb::module_& m);
void bind_queries(nb::module_& m);
void bind_trajectories(nb::module_& m);
void bind_toolkit(nb::module_& m);

// Runs f without the interpreter's lock.
template <class F>
auto without_lock(F&& f) {
  const WithoutLock released;
  return f();
}

}  // namespace onset_python
