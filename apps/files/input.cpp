#include "files/input.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "files/error.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

constexpr std::size_t kChunk = 1 << 16;

const char* what_it_is(mode_t mode) {
  if (S_ISDIR(mode)) return "is a directory";
  if (S_ISFIFO(mode)) return "is a pipe, a file expected: write what it gives into one";
  if (S_ISSOCK(mode)) return "is a socket, a file expected";
  return "is a device, a file expected";
}

// A file may be called "-", as long as it is there.
bool is_stdin(const std::string& path, bool is_there) {
  return (path == "-" && !is_there) || path == "/dev/stdin" || path == "/dev/fd/0" ||
         path == "/proc/self/fd/0";
}

bool same(const timespec& a, const timespec& b) { return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec; }

[[noreturn]] void fail_at(const std::string& path, std::size_t line, const std::string& cause) {
  throw InputError(path + ":" + std::to_string(line) + ": " + shown(cause));
}

[[noreturn]] void fail_zero(const std::string& path, std::size_t line) {
  fail_at(path, line, "a byte 0 in a text: the file is damaged, or no text");
}

std::size_t lines_of(std::string_view text) {
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
  }
  return lines.number();
}

}  // namespace

// Not to wait for a pipe's other end: O_NONBLOCK.
InputFile::InputFile(const std::string& path)
    : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  const int reason = errno;
  if (is_stdin(path, descriptor_ >= 0)) {
    if (descriptor_ >= 0) close(descriptor_);
    throw InputError(path + ": stdin is not read: write what it gives into a file, and name that");
  }
  if (descriptor_ < 0) throw InputError(path + ": " + std::strerror(reason));
  const int error = fstat(descriptor_, &opened_) == 0 ? 0 : errno;
  if (error == 0 && S_ISREG(opened_.st_mode)) return;
  close(descriptor_);
  throw InputError(path + ": " + (error ? std::strerror(error) : what_it_is(opened_.st_mode)));
}

InputFile::~InputFile() { close(descriptor_); }

void InputFile::fail(int error) const {
  throw InputError(path_ + ": cannot be read: " + std::strerror(error));
}

std::size_t InputFile::read(char* data, std::size_t size) {
  ssize_t got = 0;
  do got = ::read(descriptor_, data, size);
  while (got < 0 && errno == EINTR);
  if (got < 0) fail(errno);
  taken_ += std::uint64_t(got);
  struct stat now;
  if (got > 0) return std::size_t(got);
  if (fstat(descriptor_, &now) != 0) fail(errno);
  // Of files that the system makes up when they are read, the size is 0.
  if (!same(now.st_mtim, opened_.st_mtim) || (opened_.st_size > 0 && taken_ != size_t(opened_.st_size)))
    throw InputError(path_ + ": was changed while it was read");
  return 0;
}

void check_input(const std::string& path) { InputFile file(path); }

std::string read_rest(InputFile& file, const std::string& path, std::string bytes, bool is_text) {
  std::vector<char> chunk(kChunk);
  std::size_t looked_at = 0;
  for (std::size_t got = 1; got > 0;) {
    const std::size_t zero = is_text ? bytes.find('\0', looked_at) : bytes.npos;
    if (zero != bytes.npos) fail_zero(path, lines_of(std::string_view(bytes).substr(0, zero + 1)));
    looked_at = bytes.size();
    bytes.reserve(std::max<std::size_t>(bytes.size(), file.size()));
    got = file.read(chunk.data(), chunk.size());
    bytes.append(chunk.data(), got);
  }
  return bytes;
}

std::string read_text(const std::string& path) {
  InputFile file(path);
  return read_rest(file, path, "", true);
}

InputLines::InputLines(const std::string& path) : path_(path), file_(path), buffer_(kChunk) {
  constexpr std::size_t kMark = 3;
  while (end_ < kMark && fill()) {
  }
  begin_ = end_ - without_mark({buffer_.data(), end_}).size();
}

void InputLines::fail(const std::string& cause) const { fail_at(path_, number_, cause); }

// Makes room, and reads more.
bool InputLines::fill() {
  if (whole_) return false;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_, begin_ = 0;
  }
  if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
  const std::size_t got = file_.read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += got;
  whole_ = got == 0;
  return !whole_;
}

bool InputLines::at_end() { return begin_ == end_ && !fill(); }

bool InputLines::next(std::string_view& line) {
  if (at_end()) return false;
  ++number_;
  std::size_t end = 0;
  for (std::size_t searched = 0; (end = left().find('\n', searched)) == std::string_view::npos;) {
    searched = left().size();
    if (searched > kLongest || !fill()) break;
  }
  line = left().substr(0, end);
  if (line.size() > kLongest) fail("a line of more than " + std::to_string(kLongest) + " bytes");
  if (line.find('\0') != line.npos) fail_zero(path_, number_);
  begin_ += std::min(line.size() + 1, left().size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

}  // namespace app
