// The rules of a scene, checked.
#pragma once

#include <cstddef>
#include <string>

#include "onset/collision_rules.hpp"
#include "scene/mesh_data.hpp"

namespace onset {

// Throws std::invalid_argument that names what, the row and why.
[[noreturn]] void reject_row(const char* what, std::ptrdiff_t row, const std::string& why);
void check_size(const char* what, std::size_t size, std::ptrdiff_t wanted, const char* of);

// Sets all of `data` that rules say, in place of what was set before; what follows from it is for finish_mesh. Throws
// std::invalid_argument naming the rule and the row, and then leaves `data` in any state.
void apply_rules(const CollisionRules& rules, MeshData& data);

}  // namespace onset
