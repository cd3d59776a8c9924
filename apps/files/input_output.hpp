// Files to write. Whatever fails throws InputError naming the path and the system's reason.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace app {

// A file to write, or stdout for "-". Call close() when all is written, for a full disk may show only then.
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

// printf into a string.
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

}  // namespace app
