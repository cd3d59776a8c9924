// The module onset_ccd._onset.
#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/callbacks.hpp"
#include "conversion/options.hpp"

NB_MODULE(_onset, m) {
  using namespace onset_python;
  nb::set_leak_warnings(false);  // what the interpreter still holds when it ends is no fault of the program
  m.doc() = "Conservative continuous collision detection: the calls of include/onset, on numpy arrays.";
  m.attr("__version__") = ONSET_VERSION;
  end_callbacks_at_exit();
  bind_enums(m);
  bind_results(m);
  bind_rules(m);
  bind_mesh(m);
  bind_candidates(m);
  bind_close_pairs(m);
  bind_steps(m);
  bind_line_search(m);
  bind_maps(m);
  bind_active_sets(m);
  bind_starts(m);
  bind_queries(m);
  bind_trajectories(m);
  bind_toolkit(m);
  m.def("_option_docs", &option_docs, "The comment of each option, by name.");
  m.def(
      "_viewed",
      [](nb::handle x) {
        const PositionsArgument a("x", x);
        return nb::make_tuple(std::uintptr_t(a->data()), a->row_stride(), a->col_stride());
      },
      "Where the library reads positions: the address of the first one, and the doubles to the next row and "
      "column.");
}
