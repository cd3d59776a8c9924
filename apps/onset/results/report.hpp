// The pieces that the subcommands' results share, as JSON, CSV and words.
#pragma once

#include <onset/active_set.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <onset/step_size.hpp>
#include <optional>
#include <string>

#include "measure/timing.hpp"
#include "onset/results/outputs.hpp"

namespace app {

const char* norm_name(onset::Norm norm);  // "euclidean" or "maximum"
const char* exactness_name(onset::Exactness level);
Json to_json(const onset::PairCounts& counts);  // {vf, ee}
// An outcome in the words of the output: max_checks is "budget" there.
const char* outcome_name(onset::Outcome outcome);
const char* outcome_name(onset::PairOutcome outcome);
Json to_json(const onset::Pair& pair);                 // {kind, a, b, vertices}
Json to_json(const std::optional<onset::Pair>& pair);  // null for none
Json to_json(const onset::FilterCounts& plan);
Json to_json(const onset::Stats& stats);
Json seconds_json(const onset::Stats& stats);  // {broad, narrow, total}
Json spread_json(const Spread& spread);        // {median, min, max}
Json time_json(double time);                   // null for never
Json step_json(const onset::StepResult& result);
Json active_set_json(const onset::ActiveSet& set);

// The columns of their CSV, as the help has them.
inline constexpr char kActiveSetColumns[] =
    "kind,a,b,toi,v0,v1,v2,v3,status,certain,toi_hi,w0,w1,w2,w3,nx,ny,nz,gap,speed,degenerate,step_limit";
// What these mean.
inline constexpr char kActiveSetHelp[] =
    "(vf: vertex and face; ee: edges in the order of igl::edges; ve: vertex and edge, with --dim 2; vp: "
    "vertex "
    "and plane; w: weights of the vertices at the contact point; n: unit normal; speed < 0 closes)";
inline constexpr char kStepColumns[] = "outcome,step,kind,a,b,v0,v1,v2,v3,toi,toi_hi,rounding";
void write_active_set_csv(Output& csv, const onset::ActiveSet& set);
void write_step_csv(Output& csv, const onset::StepResult& result);

std::string describe(const onset::Pair& pair);      // "vertex 3 and face 7 (vertices 3; 1 2 9)"
std::string describe_edge(int edge, int v, int w);  // "edge 4 (vertices 1 2)", or "point 1 (edge 4)"
std::string describe(const onset::PairCounts& counts);
std::string describe_step(const onset::StepResult& result);
std::string describe_active_set(const onset::ActiveSet& set);  // with its stats
std::string describe_sizes(std::ptrdiff_t vertices, std::ptrdiff_t edges, std::ptrdiff_t faces);
std::string describe_sizes(const onset::Mesh& mesh);
std::string describe_stats(const onset::Stats& stats);  // candidates, tolerance, seconds

}  // namespace app
