// The recorded steps, and what their exchange takes.
#pragma once

#include <mpi.h>

#include <string>

#include "tests/mpi/check.hpp"

namespace onset::tests {

// (c) folder: with the scenes' folders in it.
void check_recorded(MPI_Comm comm, const std::string& folder, Checks& checks);

// (c) Prints what a step of each exchanges, cut by bisection, and counts ranks with more than twice the
// ghosts that lie within reach, or more memory than is promised.
void check_exchange(MPI_Comm comm, const std::string& folder, Checks& checks);

}  // namespace onset::tests
