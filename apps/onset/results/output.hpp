// Where results go: JSON, CSV and the summary for people.
#pragma once

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "onset/command_line/arguments.hpp"

namespace app {

using Json = nlohmann::ordered_json;

// A file, or stdout for "-". Every failure to open or write throws InputError naming the path and the reason;
// call close() when all is written, for a full disk may show only then.
class Output {
 public:
  explicit Output(const std::string& path);
  void write(std::string_view text);
  void close();

 private:
  [[noreturn]] void fail();
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdout) std::fclose(file);
    }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

// Opened before the work starts, so that a path that cannot be written is known at once. The summary goes to
// stdout unless JSON or CSV does.
class Outputs {
 public:
  explicit Outputs(const Arguments& arguments);
  Output* csv() { return csv_ ? &*csv_ : nullptr; }
  // What comes before the summary, is the last key, "notes", of the JSON, and on stderr where neither is asked for.
  void note(const std::string& text) { notes_.push_back(text); }
  void finish(Json json, const std::string& summary);

 private:
  std::vector<std::string> notes_;
  std::optional<Output> json_, csv_, summary_;
};

// printf into a string.
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

}  // namespace app
