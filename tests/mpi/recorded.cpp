#include "tests/mpi/recorded.hpp"

#include <cstdio>
#include <onset/mpi/mpi.hpp>

#include "mpi/exchange/box_groups.hpp"
#include "tests/mpi/memory.hpp"
#include "tests/scenes/frame_file.hpp"

namespace onset::tests {
namespace {

// most_memory: of a rank, for that of one process with as many primitives; what does not depend on their
// number weighs more in small scenes.
struct Step {
  const char *folder, *from, *to;
  double most_memory;
};
constexpr Step kSteps[] = {{"cloth-ball", "cloth_ball92", "cloth_ball93", 1.1},
                           {"armadillo-rollers", "326", "327", 1.2},
                           {"cloth-funnel", "227", "228", 1.2}};

// For each primitive within reach of another rank's (docs/distributed.md).
constexpr double kMostGhosts = 2;

WholeScene read(const std::string& folder, const Step& step) {
  const std::string frames = folder + "/" + step.folder + "/frames/";
  const scenes::Frame t0 = scenes::read_frame(frames + step.from + ".ply");
  const scenes::Frame t1 = scenes::read_frame(frames + step.to + ".ply");
  WholeScene r;
  r.name = step.folder;
  r.mesh = Mesh(t0.x, t0.faces);
  r.x_t0 = t0.x, r.x_t1 = t1.x;
  r.d_hat = 1e-3 * (t0.x.colwise().maxCoeff() - t0.x.colwise().minCoeff()).maxCoeff();
  return r;
}

template <std::size_t N>
mpi::Box box_of(const WholeScene& s, const std::array<int, N>& vertices) {
  mpi::Box box = mpi::Box::none();
  for (const int v : vertices)
    for (int end = 0; end < 2; ++end)
      for (int a = 0; a < 3; ++a) {
        const double x = end == 0 ? s.x_t0(v, a) : s.x_t1(v, a);
        box.lo[end][a] = std::min(box.lo[end][a], float(x)),
        box.hi[end][a] = std::max(box.hi[end][a], float(x));
      }
  return box;
}

// Calls f(lowest rank of the vertices, box) for all primitives.
template <class F>
void each_primitive(const WholeScene& s, const std::vector<int>& rank_of, const F& f) {
  const auto rank = [&](const auto& vertices) {
    int lowest = rank_of[std::size_t(vertices[0])];
    for (const int v : vertices) lowest = std::min(lowest, rank_of[std::size_t(v)]);
    return lowest;
  };
  const auto visit = [&](const auto& vertices) { f(rank(vertices), box_of(s, vertices)); };
  for (int v = 0; v < int(s.mesh.num_vertices()); ++v) visit(std::array<int, 1>{v});
  for (int e = 0; e < int(s.mesh.num_edges()); ++e) visit(s.mesh.edge(e));
  for (int f2 = 0; f2 < int(s.mesh.num_faces()); ++f2) visit(s.mesh.face(f2));
}

// Counts the primitives of other ranks whose boxes meet that of one of this rank.
std::int64_t within_reach(const WholeScene& s, const std::vector<int>& rank_of, int rank) {
  std::vector<mpi::Box> own;
  each_primitive(s, rank_of, [&](int of, const mpi::Box& box) {
    if (of == rank) own.push_back(box);
  });
  std::sort(own.begin(), own.end(),
            [](const mpi::Box& x, const mpi::Box& y) { return x.lo[0][0] < y.lo[0][0]; });
  const mpi::BoxTree tree(std::move(own));
  std::int64_t count = 0;
  each_primitive(s, rank_of, [&](int of, const mpi::Box& box) { count += of != rank && tree.meets(box); });
  return count;
}

void check_exchange(MPI_Comm comm, const WholeScene& s, double most_memory, Checks& checks) {
  int size = 1, rank = 0;
  MPI_Comm_size(comm, &size), MPI_Comm_rank(comm, &rank);
  const std::vector<int> rank_of = ranks_of_vertices(s, Cut::rcb, size, 0);
  const std::int64_t near = within_reach(s, rank_of, rank);
  const std::int64_t all = s.mesh.num_vertices() + s.mesh.num_edges() + s.mesh.num_faces();
  std::int64_t serial = 0, here = 0;
  for (const int turn : {0, 1}) {  // the second has what the first has set up once a process
    const MemoryUse use;
    const Mesh mesh(s.x_t0, [&] {
      Eigen::MatrixXi faces(s.mesh.num_faces(), 3);
      for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int c = 0; c < 3; ++c) faces(f, c) = s.mesh.face(f)[std::size_t(c)];
      return faces;
    }());
    compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1);
    if (turn == 1) serial = use.peak();
  }
  const mpi::MeshPart part = part_of(s, rank_of, rank);
  const Eigen::MatrixXd x_t0 = rows_of(part, s.x_t0), x_t1 = rows_of(part, s.x_t1);
  const MemoryUse use;
  const mpi::Mesh mesh(comm, part);
  const StepResult step = mpi::compute_collision_free_stepsize(mesh, x_t0, x_t1);
  here = use.peak();
  const mpi::Exchange& e = mesh.exchange();
  const std::int64_t owned = e.owned[0] + e.owned[1] + e.owned[2],
                     ghosts = e.ghosts[0] + e.ghosts[1] + e.ghosts[2];
  const double share = double(serial) / double(all) * double(owned + ghosts);
  std::vector<double> row{
      double(owned),           double(ghosts),  double(near),         double(e.bytes_sent),
      double(e.messages_sent), double(e.pairs), double(here) / share, double(serial) / double(all)};
  std::vector<double> rows(row.size() * std::size_t(size));
  MPI_Gather(row.data(), int(row.size()), MPI_DOUBLE, rows.data(), int(row.size()), MPI_DOUBLE, 0, comm);
  if (rank != 0) return;
  std::printf(
      "%s, rcb, step %.17g\n  rank   owned  ghosts  within reach  bytes sent  messages   pairs  memory / "
      "share\n",
      s.name.c_str(), step.step);
  for (int r = 0; r < size; ++r) {
    const double* x = rows.data() + std::size_t(r) * row.size();
    std::printf("  %4d %7.0f %7.0f %13.0f %11.0f %9.0f %7.0f %15.3f\n", r, x[0], x[1], x[2], x[3], x[4], x[5],
                x[6]);
    ++checks.calls;
    if (x[1] > kMostGhosts * x[2] || x[6] > most_memory) ++checks.different;
  }
  std::printf("  one process: %.0f bytes a primitive\n", row[7]);
}

}  // namespace

void check_recorded(MPI_Comm comm, const std::string& folder, Checks& checks) {
  for (const Step& step : kSteps) check_scene(comm, read(folder, step), 1, checks);
}

void check_exchange(MPI_Comm comm, const std::string& folder, Checks& checks) {
  for (const Step& step : kSteps) check_exchange(comm, read(folder, step), step.most_memory, checks);
}

}  // namespace onset::tests
