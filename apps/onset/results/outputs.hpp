// Where results go: JSON, CSV, files for other programs, and the summary for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "files/output_files.hpp"
#include "onset/command_line/arguments.hpp"

namespace app {

using Json = nlohmann::ordered_json;

// Made, and all outputs announced, before the work starts, so that a path that cannot be written is known at
// once. No file is touched before finish(). The summary goes to stdout unless another output does.
class Outputs {
 public:
  // `inputs`: all that the run reads.
  Outputs(const Arguments& arguments, const std::vector<std::string>& inputs);

  // null where no CSV is asked for.
  Output* csv() { return csv_.empty() ? nullptr : &files_.open(csv_); }
  // Beside JSON and CSV.
  void announce(const std::string& option, const std::string& path);
  Output& file(const std::string& path) { return files_.open(path); }
  // What comes before the summary, is the last key, "notes", of the JSON, and on stderr where neither is
  // asked for.
  void note(const std::string& text) { notes_.push_back(text); }
  void finish(Json json, const std::string& summary);

 private:
  OutputFiles files_;
  std::vector<std::string> notes_;
  std::string json_, csv_;
  bool has_summary_ = true;
};

}  // namespace app
