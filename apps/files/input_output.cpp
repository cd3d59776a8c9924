#include "files/input_output.hpp"

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
