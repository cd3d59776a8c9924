// From the pairs that a traversal found to contacts.
#pragma once

#include <vector>

#include "narrowphase/distance/contact_geometry.hpp"
#include "onset/active_set.hpp"
#include "scene/motion/motion.hpp"
#include "src/shared/pair_traversal.hpp"

namespace onset {

void put(const PairResult& result, Contact& contact);
void put(const ContactGeometry& geometry, Contact& contact);

// Contact i of `set` is found[i]; counts those of each kind.
void fill_contacts(const Mesh& mesh, const Motion& motion, InstructionSet instruction_set,
                   const std::vector<FoundPair>& found, ActiveSet& set);

}  // namespace onset
