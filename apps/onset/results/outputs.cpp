#include "onset/results/outputs.hpp"

#include <cstdio>

namespace app {

Outputs::Outputs(const Arguments& arguments) {
  if (!arguments.json.empty()) json_.emplace(arguments.json);
  if (!arguments.csv.empty()) csv_.emplace(arguments.csv);
  if (arguments.json != "-" && arguments.csv != "-") summary_.emplace("-");
}

void Outputs::finish(Json json, const std::string& summary) {
  std::string said;
  for (const std::string& note : notes_) said += "note        " + note + "\n";
  if (csv_) csv_->close();
  if (json_) {
    if (!notes_.empty()) json["notes"] = notes_;
    json_->write(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    json_->close();
  }
  if (!json_ && !summary_) std::fputs(said.c_str(), stderr);
  if (summary_) {
    summary_->write(said + summary);
    summary_->close();
  }
}

}  // namespace app
