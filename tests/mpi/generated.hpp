// Scenes made of a number, of every kind of rule and of every kind of trouble.
#pragma once

#include "tests/mpi/partition.hpp"

namespace onset::tests {

// The first `kSmallScenes` are one of each kind.
inline constexpr int kSmallScenes = 22;
WholeScene generated(int number);

}  // namespace onset::tests
