// Contacts made of the pairs that a traversal found.
#pragma once

#include <vector>

#include "base/stop.hpp"
#include "narrowphase/distance/contact_geometry.hpp"
#include "onset/active_set.hpp"
#include "scene/motion/motion.hpp"
#include "src/shared/pair_traversal.hpp"

namespace onset {

// Copy a result, or a geometry, into the fields of a contact.
void put(const PairResult& result, Contact& contact);
void put(const ContactGeometry& geometry, Contact& contact);

// Returns the least toi; infinite where there is none.
double earliest_toi(const std::vector<FoundPair>& found);
// Cuts off what Options::window and memory_limit exclude, in the order (toi, kind, a, b), and sets outcome
// and complete_until. earliest: of the whole scene.
void cut_off(std::vector<FoundPair>& found, double earliest, const Options& options, Outcome outcome,
             ActiveSet& set);

// Makes contact i of `set` from found[i], which are sorted by `before`, and counts those of each kind. Where
// it is stopped, only the first of these.
void fill_contacts(const Mesh& mesh, const Motion& motion, const Options& options,
                   const std::vector<FoundPair>& found, const Stop& stop, ActiveSet& set);

}  // namespace onset
