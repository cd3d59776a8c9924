// mpirun -n 4 petsc_constraints A B: the contacts of a step as rows of a matrix of PETSc's, by its COO
// interface.
//
// Each rank has the rows of its contacts. Columns are 3 vertex + axis in the ids of the scene; a solver would
// have its own numbers, for which assemble_constraints takes a list.
#include <petscmat.h>

#include <cstdio>
#include <onset/mpi/mpi.hpp>
#include <onset/onset.hpp>
#include <vector>

#include "files/scene/scene.hpp"
#include "mpi/partition.hpp"

namespace {

Mat assemble(const onset::Constraints& c, std::int64_t vertices) {
  Mat A = nullptr;
  MatCreate(PETSC_COMM_WORLD, &A);
  MatSetSizes(A, PetscInt(c.rows()), PETSC_DECIDE, PETSC_DETERMINE, PetscInt(3 * vertices));
  MatSetType(A, MATAIJ);
  PetscInt first = 0, rows = PetscInt(c.rows());
  MPI_Exscan(&rows, &first, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD);
  std::vector<PetscInt> i, j(c.dof.begin(), c.dof.end());
  for (const int row : c.row) i.push_back(first + row);
  MatSetPreallocationCOO(A, PetscCount(i.size()), i.data(), j.data());
  MatSetValuesCOO(A, c.value.data(), INSERT_VALUES);
  return A;
}

void run(const char* a, const char* b) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank), MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
  const app::Scene scene = app::read_scene(a, b);
  const Eigen::MatrixXd x_t0 = scene.x_t0, x_t1 = scene.x_t1;
  const auto rank_of = app::ranks_of_vertices(x_t0, app::Partition::rcb, ranks);
  const onset::mpi::MeshPart part = app::part_of(scene.mesh, rank_of, rank, true);
  const onset::mpi::Mesh mesh(PETSC_COMM_WORLD, part);
  const onset::mpi::ActiveSet set =
      onset::mpi::construct_active_set(mesh, app::rows_of(part, x_t0), app::rows_of(part, x_t1));
  Mat A = assemble(onset::assemble_constraints(set), mesh.num_vertices());
  PetscInt rows = 0, columns = 0;
  PetscReal norm = 0;
  MatGetSize(A, &rows, &columns);
  MatNorm(A, NORM_FROBENIUS, &norm);
  PetscPrintf(PETSC_COMM_WORLD, "%d constraints on %d degrees of freedom, norm %.12g\n", int(rows),
              int(columns), double(norm));
  MatDestroy(&A);
}

}  // namespace

int main(int argc, char** argv) {
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  int code = 0;
  try {
    if (argc < 3) throw std::runtime_error("usage: petsc_constraints A B");
    run(argv[1], argv[2]);
  } catch (const std::exception& e) {  // all ranks fail alike
    PetscPrintf(PETSC_COMM_WORLD, "petsc_constraints: %s\n", e.what());
    code = 1;
  }
  PetscFinalize();
  return code;
}
