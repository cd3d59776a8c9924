// One query, one answer: the promise that it breaks is a failure.
#pragma once

#include <string>

#include "tests/catch.hpp"
#include "tests/narrowphase/separation.hpp"

namespace onset::tests {

inline void check_promises(const std::string& source, const scenes::Query& query, const Options& options) {
  const QueryResult result = ccd(query, options);
  if (const std::string broken = broken_promise(query, options, result); !broken.empty())
    FAIL_CHECK(source << ": " << broken << "\n  " << to_text(query) << "\n  "
                      << oracle::to_text(options, result));
}

}  // namespace onset::tests
