#include "onset/results/outputs.hpp"

#include <cstdio>

namespace app {

Outputs::Outputs(const Arguments& arguments, const std::vector<std::string>& inputs)
    : files_(inputs), json_(arguments.json), csv_(arguments.csv) {
  if (!json_.empty()) announce("--json", json_);
  if (!csv_.empty()) announce("--csv", csv_);
}

void Outputs::announce(const std::string& option, const std::string& path) {
  files_.announce(option, path);
  if (path == "-") has_summary_ = false;
}

// Files are complete before the summary goes to a pipe, whose reader may have gone.
void Outputs::finish(Json json, const std::string& summary) {
  std::string said;
  for (const std::string& note : notes_) said += "note        " + note + "\n";
  if (!notes_.empty()) json["notes"] = notes_;
  if (!json_.empty())
    files_.open(json_).write(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  files_.publish();
  if (json_.empty() && !has_summary_) std::fputs(said.c_str(), stderr);
  if (!has_summary_) return;
  Output out("-");
  out.write(said + summary);
  out.finish();
}

}  // namespace app
