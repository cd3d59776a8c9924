// What onset::check finds, in words, JSON, CSV and PLY.
#pragma once

#include <onset/check.hpp>
#include <optional>
#include <string>

#include "files/scene/scene.hpp"
#include "onset/results/outputs.hpp"

namespace app {

// Copies of vertices, by whether they are still together at the end of a step.
struct CopiedVertices {
  std::vector<std::array<int, 2>> together, parting;
};
CopiedVertices at_the_end(const std::vector<std::array<int, 2>>& copies, const Points& x_t1);

struct StartFindings {
  const Scene& scene;
  const onset::StartReport& report;
  std::optional<CopiedVertices> copies;  // where the end of a step is known
};

std::string describe(const StartFindings& findings);  // of each kind the first ten
Json to_json(const StartFindings& findings);

// fault,kind,a,b,v0,v1,v2,v3,v4,distance,separation: one row each, empty where there is no such value
void write_csv(Output& csv, const StartFindings& findings);
inline constexpr char kStartColumns[] = "fault,kind,a,b,v0,v1,v2,v3,v4,distance,separation";

// Edges that intersect faces red, the faces yellow, what touches without that blue; `id`: the vertex that
// each corner is.
void write_start_ply(Output& file, const Scene& scene, const onset::StartReport& report);

}  // namespace app
