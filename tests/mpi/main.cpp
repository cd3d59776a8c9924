// mpirun -n N test_mpi small | generated COUNT | recorded FOLDER | exchange FOLDER | faults COUNT
//
// Rank 0 prints what was checked. Ends with 1 where anything differs from the answers of one process.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/mpi/faults.hpp"
#include "tests/mpi/generated.hpp"
#include "tests/mpi/recorded.hpp"

namespace onset::tests {
namespace {

int run(int argc, char** argv) {
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank), MPI_Comm_size(MPI_COMM_WORLD, &size);
  const std::string what = argc > 1 ? argv[1] : "small";
  const int count = argc > 2 ? std::atoi(argv[2]) : kSmallScenes;
  Checks checks;
  if (what == "small" || what == "generated") {
    for (int i = 0; i < count; ++i) check_scene(MPI_COMM_WORLD, generated(i), unsigned(i), checks);
  } else if (what == "recorded") {
    check_recorded(MPI_COMM_WORLD, argc > 2 ? argv[2] : ".", checks);
  } else if (what == "exchange") {
    check_exchange(MPI_COMM_WORLD, argc > 2 ? argv[2] : ".", checks);
  } else if (what == "faults") {
    inject_faults(MPI_COMM_WORLD, count, checks);
  } else {
    if (rank == 0) std::fprintf(stderr, "test_mpi: no test '%s'\n", what.c_str());
    return 2;
  }
  long different = checks.different;
  MPI_Bcast(&different, 1, MPI_LONG, 0, MPI_COMM_WORLD);
  if (rank == 0)
    std::printf("%s, %d ranks: %ld checked, %ld differ\n", what.c_str(), size, checks.calls,
                checks.different);
  return different == 0 ? 0 : 1;
}

}  // namespace
}  // namespace onset::tests

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int result = onset::tests::run(argc, argv);
  MPI_Finalize();
  return result;
}
