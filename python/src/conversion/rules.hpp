// Rules as an argument.
#pragma once

#include <nanobind/nanobind.h>

#include <onset/collision_rules.hpp>

namespace onset_python {

// None: no rules.
onset::CollisionRules rules_of(nanobind::handle rules);

}  // namespace onset_python
