// What one run writes: nothing of it is seen before all of it is complete, and none of it replaces an input.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "files/output.hpp"

namespace app {

class OutputFiles {
 public:
  // Paths that the run reads, which may not be there.
  explicit OutputFiles(const std::vector<std::string>& inputs);

  // `path` may be written, as `option` says. Throws InputError where it cannot be, UsageError where it is an
  // input or another output, by whatever name. Touches nothing.
  void announce(const std::string& option, const std::string& path);
  // One that was announced; from now on it will be written.
  Output& open(const std::string& path);
  // Once all that were opened are written, what has no place to take (pipes, devices, stdout) being flushed,
  // the files take their places together.
  void publish();

 private:
  struct Input {
    std::string path;
    struct stat file;
  };
  struct Entry {
    std::string option;
    std::string path;
    std::unique_ptr<Output> file;
    bool is_open = false;
  };
  void check_inputs(const OutputTarget& target, const std::string& option) const;
  void check_others(const OutputTarget& target, const std::string& option) const;
  void write_all();
  std::vector<Input> inputs_;
  std::vector<Entry> entries_;
};

}  // namespace app
