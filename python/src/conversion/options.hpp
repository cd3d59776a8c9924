// Options of a call: keyword arguments by the names of onset::Options.
#pragma once

#include <nanobind/nanobind.h>

#include <onset/line_search.hpp>
#include <onset/options.hpp>
#include <onset/truncate_step.hpp>
#include <string>

namespace onset_python {

namespace nb = nanobind;

// Reads the options that a call was given. TypeError for a name that there is none of, and for a value of
// another type.
//
// A signal, such as KeyboardInterrupt, ends the call of the main thread: its handler runs where the call
// looks at progress. `progress` is called with the interpreter's lock; what is false, but for None, cancels
// the call.
onset::Options options_of(const nb::kwargs& named);
// Of a query of one pair, which looks at neither signals nor progress.
onset::Options query_options_of(const nb::kwargs& named);
onset::LineSearchOptions line_search_options_of(const nb::kwargs& named);
onset::TruncateOptions truncate_options_of(const nb::kwargs& named);

// The comment of each option, by name.
nb::dict option_docs();

}  // namespace onset_python
