// Answers of onset/compat/ipc.hpp for a scene in a file: #V, #F (int64), x_t0, x_t1 (#V x 3 doubles, rows),
// faces
// (#F x 3 int32).
//   print_ipc_steps FILE MIN_DISTANCE        prints: step, step of candidates, free, candidates, step without
//   even vertices
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <onset/compat/ipc.hpp>

namespace ipc = onset::ipc;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::ifstream in(argv[1], std::ios::binary);
  std::int64_t sizes[2] = {0, 0};
  in.read(reinterpret_cast<char*>(sizes), sizeof sizes);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Rows x[2] = {Rows(sizes[0], 3), Rows(sizes[0], 3)};
  for (Rows& m : x) in.read(reinterpret_cast<char*>(m.data()), m.size() * 8);
  Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor> faces(sizes[1], 3);
  in.read(reinterpret_cast<char*>(faces.data()), faces.size() * 4);
  if (!in) return 1;

  const Eigen::MatrixXd x0 = x[0], x1 = x[1];
  const double distance = std::atof(argv[2]);
  ipc::CollisionMesh mesh(x0, onset::edges(faces), faces);
  ipc::Candidates candidates;
  candidates.build(mesh, x0, x1, distance / 2);
  const double step = ipc::compute_collision_free_stepsize(mesh, x0, x1, distance);
  const double listed = candidates.compute_collision_free_stepsize(mesh, x0, x1, distance);
  const bool free = ipc::is_step_collision_free(mesh, x0, x1, distance);
  mesh.can_collide = [](std::size_t i, std::size_t j) { return i % 2 == 1 || j % 2 == 1; };
  const double filtered = ipc::compute_collision_free_stepsize(mesh, x0, x1, distance);
  std::printf("%.17g %.17g %d %zu %.17g\n", step, listed, int(free), candidates.size(), filtered);
}
