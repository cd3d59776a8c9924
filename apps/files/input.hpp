// Files to read. Whatever fails throws InputError naming the path and the cause.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace app {

// A regular file, open for reading. Pipes and devices are refused: nothing says how much they hold, and a
// pipe cannot be read a second time.
class InputFile {
 public:
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::uint64_t size() const { return std::uint64_t(opened_.st_size); }
  // Up to `size` bytes more; 0 at the end, where it throws if the file has changed since it was opened.
  std::size_t read(char* data, std::size_t size);

 private:
  [[noreturn]] void fail(int error) const;
  std::string path_;
  int descriptor_;
  struct stat opened_;
  std::uint64_t taken_ = 0;
};

// That it can be opened.
void check_input(const std::string& path);

// All bytes of a text, which holds no byte 0.
std::string read_text(const std::string& path);
// All that `file` has left behind `head`, which was read before; a text may hold no byte 0.
std::string read_rest(InputFile& file, const std::string& path, std::string head, bool is_text);

// The lines of a text, one after another, for files that need not be in memory as a whole.
class InputLines {
 public:
  static constexpr std::size_t kLongest = 1 << 20;

  explicit InputLines(const std::string& path);
  // Without its end, LF or CR LF. Throws for a byte 0 and for a line of more than kLongest bytes.
  bool next(std::string_view& line);
  bool at_end();                                  // takes back what next() gave
  std::size_t number() const { return number_; }  // of the line that next() gave, from 1
  [[noreturn]] void fail(const std::string& cause) const;

 private:
  bool fill();
  std::string_view left() const { return {buffer_.data() + begin_, end_ - begin_}; }
  std::string path_;
  InputFile file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0, number_ = 0;
  bool whole_ = false;  // nothing is left to read
};

}  // namespace app
