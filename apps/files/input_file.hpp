// Opens a file to read.
#pragma once

#include <fstream>
#include <string>

namespace app {

// In binary mode. Throws InputError naming the path and the system's reason.
std::ifstream open_input(const std::string& path);

}  // namespace app
