// Compares the calls over ranks with those of one process.
#pragma once

#include <mpi.h>

#include <string>

#include "tests/mpi/partition.hpp"

namespace onset::tests {

struct Checks {
  long calls = 0, different = 0;
};

// (c) Asks all calls of a scene, cut in every way, and counts on rank 0 which differ; says so on stderr.
void check_scene(MPI_Comm comm, const WholeScene& scene, unsigned seed, Checks& checks);

}  // namespace onset::tests
