// Queries of a step written down, to be asked again one by one: appendix A of Wang, Ferguson et al. 2021.
#pragma once

#include <onset/onset.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/mesh/mesh_file.hpp"
#include "files/queries/query_file.hpp"
#include "onset/results/outputs.hpp"

namespace app {

struct DumpedPair {
  onset::Pair pair;
  const char* why;  // "limiting", "worst", "contact", "budget"
};

// Writes NAME-vf.csv and NAME-ee.csv (eight rows a query, exactly the doubles; truth: what onset answers) for
// those kinds that there are, NAME being `path` without ".csv", and beside each NAME-vf.json, NAME-ee.json:
// the options and what each query is answered. `tolerance`: the one the step was taken with, model length.
// Returns the CSV paths.
std::vector<std::string> write_dump(const std::string& path, const std::vector<DumpedPair>& pairs,
                                    const Points& x_t0, const Points& x_t1, const onset::Options& options,
                                    double tolerance);

// What a dump says that its queries are answered.
struct Expectation {
  onset::Options options;
  struct Answer {
    std::string outcome;
    double toi;
    std::int64_t checks;
  };
  std::vector<Answer> answers;
};

// Beside the CSV file `path`; none where there is no such file. Throws InputError where it cannot be
// understood.
std::optional<Expectation> read_expectation(const std::string& path);

}  // namespace app
