// Everything that onset offers on MPI.
#pragma once

#include <onset/mpi/calls.hpp>
#include <onset/mpi/line_search.hpp>
#include <onset/mpi/mesh.hpp>
