// From the pairs that a traversal found to the rows of an active set.
#pragma once

#include <vector>

#include "scene/motion.hpp"
#include "src/shared/pair_traversal.hpp"

namespace onset {

// Row i of `set` is found[i]; counts the contacts of each kind.
void fill_rows(const Mesh& mesh, const Motion& motion, InstructionSet kernel, const std::vector<FoundPair>& found,
               ActiveSet& set);

}  // namespace onset
