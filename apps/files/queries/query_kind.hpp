// Vertex-face or edge-edge: the words for it, and what the path of a file says.
#pragma once

#include <onset/result.hpp>
#include <string>

namespace app {

const char* kind_name(onset::PairKind kind);  // "vf", "ee", "ve" or "vp"

// The kind that a path tells by "vertex-face" or "vf", "edge-edge" or "ee" as whole words of letters
// ("326vf.csv"), the file's name before its folders. Throws InputError where it tells none, or both at once.
onset::PairKind kind_from_path(const std::string& path);

// `name`: that of the kind, empty where the path tells.
onset::PairKind kind_of_file(const std::string& path, const std::string& name);

}  // namespace app
