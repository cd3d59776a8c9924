// Where results go: JSON, CSV and the summary for people.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/input_output.hpp"
#include "onset/command_line/arguments.hpp"

namespace app {

using Json = nlohmann::ordered_json;

// Opened before the work starts, so that a path that cannot be written is known at once. The summary goes to
// stdout unless JSON or CSV does.
class Outputs {
 public:
  explicit Outputs(const Arguments& arguments);
  Output* csv() { return csv_ ? &*csv_ : nullptr; }
  // What comes before the summary, is the last key, "notes", of the JSON, and on stderr where neither is
  // asked for.
  void note(const std::string& text) { notes_.push_back(text); }
  void finish(Json json, const std::string& summary);

 private:
  std::vector<std::string> notes_;
  std::optional<Output> json_, csv_, summary_;
};

}  // namespace app
