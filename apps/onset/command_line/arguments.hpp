// The options that every subcommand has.
#pragma once

#include <CLI/CLI.hpp>
#include <onset/options.hpp>
#include <string>

namespace app {

struct Arguments {
  onset::Options options;
  std::string broad_phase = "auto", narrow_phase = "auto", kernel = "auto", certainty = "certify",
              norm = "euclidean";
  std::string json, csv;  // a path, "-" for stdout, empty for none
};

// Adds them to `command`; `arguments` must outlive the parse. `csv_columns` goes into the help.
void add_common_options(CLI::App& command, Arguments& arguments, const std::string& csv_columns);

// --json alone.
void add_json(CLI::App& command, Arguments& arguments);

// --window, of active sets.
void add_window(CLI::App& command, Arguments& arguments);

// --kind, of queries: "vf", "ee" or what each path tells. `how`: goes on with the help.
void add_kind(CLI::App& command, std::string& kind, const std::string& how = "");

// Of two frames of a mesh.
inline constexpr char kMeshHelp[] = "Mesh at the start of the step: .ply, .obj, .off or .stl";
inline constexpr char kEndHelp[] =
    "The same mesh at its end: the same faces, wires and points in the same order";

// What the library takes.
onset::Options to_options(const Arguments& arguments);

}  // namespace app
