#include "files/input_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "files/error.hpp"

namespace app {

std::ifstream open_input(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(path + ": is a directory");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": " + std::strerror(errno));
  return in;
}

}  // namespace app
