// Faults on one rank, of every kind that a solver or its author can make.
#pragma once

#include <mpi.h>

#include "tests/mpi/check.hpp"

namespace onset::tests {

// (c) Injects so many faults, each into one call on one rank, and counts on rank 0 those after which ranks do
// not end alike, or not within seconds.
void inject_faults(MPI_Comm comm, int count, Checks& checks);

}  // namespace onset::tests
