// Rules of a mesh changed, the others kept.
#pragma once

#include <onset/mesh.hpp>

namespace onset::scenes {

// change(CollisionRules&) says what is to be different.
template <class F>
void change_rules(Mesh& mesh, const F& change) {
  CollisionRules rules = mesh.rules();
  change(rules);
  mesh.set_rules(rules);
}

template <class T>
struct Rule {
  using Value = T;
};
// set_rule(mesh, &CollisionRules::weld, true)
template <class T>
void set_rule(Mesh& mesh, T CollisionRules::*rule, const typename Rule<T>::Value& value) {
  change_rules(mesh, [&](CollisionRules& rules) { rules.*rule = value; });
}

}  // namespace onset::scenes
