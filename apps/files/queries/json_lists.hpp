// Lists in JSON, read value by value: what a file asks for beside them is refused before it takes memory.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace app {

// [[id, id], ...]. Throws InputError naming the file.
std::vector<std::array<std::int64_t, 2>> read_id_pairs(const std::string& path);

// [true, false, ...]. Throws InputError naming the file.
std::vector<bool> read_flags(const std::string& path);

}  // namespace app
