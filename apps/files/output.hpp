// Files to write. Whatever fails throws InputError naming the path and the system's reason.
#pragma once

#include <sys/stat.h>

#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace app {

// Where what is written to a path goes.
struct OutputTarget {
  enum class Kind {
    beside,    // a file that takes the place of the one at `path`, or is new there, when it is complete
    in_place,  // pipes, devices, what /dev/fd names
    standard,  // stdout, also where another name of it is given
  };
  Kind kind;
  std::string name;                   // as it was given, for messages
  std::string path;                   // behind all links
  std::optional<struct stat> now;     // what is there
  std::optional<struct stat> folder;  // of a file that is beside

  bool is_same(const OutputTarget& other) const;
  bool is(const struct stat& file) const;
};

// "-": stdout. Throws where it could not be written: no folder, no permission. Touches nothing.
OutputTarget output_target(const std::string& path);

// Nothing is touched before the first write. What was at the path is there until publish(); without it, the
// file beside it is removed again.
class Output {
 public:
  explicit Output(OutputTarget target) : target_(std::move(target)) {}
  explicit Output(const std::string& path) : Output(output_target(path)) {}
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  const OutputTarget& target() const { return target_; }
  bool is_replaced_at_end() const { return target_.kind == OutputTarget::Kind::beside; }
  void write(std::string_view text);
  void flush();
  // All is written and closed, or it throws: a full disk may show only then.
  void finish();
  // The name that it has until it is published, empty where there is nothing to publish.
  const std::string& unpublished() const { return unfinished_; }
  void published() { unfinished_.clear(); }
  // finish(), and it takes its place.
  void publish();

 private:
  void open();
  void open_beside();
  [[noreturn]] void fail(int error);
  OutputTarget target_;
  std::string unfinished_;
  std::FILE* file_ = nullptr;
  bool finished_ = false;
};

// printf into a string.
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

}  // namespace app
