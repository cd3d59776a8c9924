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

// NAME-vf.csv, NAME-vf.json, NAME-ee.csv and NAME-ee.json, NAME being `path` without ".csv".
std::vector<std::string> dump_files(const std::string& path);

// Writes the CSV (eight rows a query, exactly the doubles; truth: what onset answers) of those kinds that
// there are, and the JSON beside it: the options that a query depends on, and what each is answered with
// them. `tolerance`: the one the step was taken with, model length.
void write_dump(const std::string& path, const std::vector<DumpedPair>& pairs, const Points& x_t0,
                const Points& x_t1, const onset::Options& options, double tolerance, Outputs& outputs);

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

// The file of it beside the CSV file `path`.
std::string expectation_file(const std::string& path);
// None where there is no such file. Throws InputError where it cannot be understood.
std::optional<Expectation> read_expectation(const std::string& path);

}  // namespace app
