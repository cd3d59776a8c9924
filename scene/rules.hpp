// Collision rules, checked and put into a mesh.
#pragma once

#include <cstddef>
#include <string>

#include "onset/collision_rules.hpp"
#include "onset/export.hpp"
#include "scene/mesh_data.hpp"

namespace onset {

// Throws std::invalid_argument that names `what`, the row and why.
[[noreturn]] ONSET_API void reject_row(const char* what, std::ptrdiff_t row, const std::string& why);
// Throws std::invalid_argument where `what` has not one value for each of the `wanted` things, `of` in the
// message.
ONSET_API void check_size(const char* what, std::size_t size, std::ptrdiff_t wanted, const char* of);

// Replaces everything in `data` that rules set; finish_mesh must follow. Throws std::invalid_argument naming
// the rule and the row, and leaves `data` in an unspecified state then.
ONSET_API void apply_rules(const CollisionRules& rules, MeshData& data);

}  // namespace onset
