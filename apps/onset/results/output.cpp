#include "onset/results/output.hpp"

#include <cerrno>
#include <cstdarg>
#include <cstring>

#include "files/error.hpp"

namespace app {

Output::Output(const std::string& path) : path_(path == "-" ? "stdout" : path) {
  errno = 0;
  file_.reset(path == "-" ? stdout : std::fopen(path.c_str(), "wb"));
  if (!file_) fail();
}

void Output::write(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
}

void Output::close() {
  errno = 0;
  const bool flushed = std::fflush(file_.get()) == 0;
  std::FILE* file = file_.release();
  if (!flushed || (file != stdout && std::fclose(file) != 0)) fail();
}

void Output::fail() {
  throw InputError(path_ + ": cannot be written: " + (errno ? std::strerror(errno) : "unknown reason"));
}

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

std::string format(const char* pattern, ...) {
  va_list arguments, again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  std::string text(std::size_t(std::vsnprintf(nullptr, 0, pattern, arguments)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  va_end(arguments);
  return text;
}

}  // namespace app
