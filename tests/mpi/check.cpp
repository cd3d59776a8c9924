#include "tests/mpi/check.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <onset/mpi/mpi.hpp>
#include <type_traits>

#include "tests/src/support/answer.hpp"

namespace onset::tests {
namespace {

// What all ranks have, on rank 0.
template <class T>
std::vector<T> gathered(MPI_Comm comm, const std::vector<T>& mine) {
  static_assert(std::is_trivially_copyable_v<T>);
  int size = 1, rank = 0, bytes = int(mine.size() * sizeof(T));
  MPI_Comm_size(comm, &size), MPI_Comm_rank(comm, &rank);
  std::vector<int> counts(std::size_t(size), 0), places(std::size_t(size), 0);
  MPI_Gather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  for (int r = 1; r < size; ++r)
    places[std::size_t(r)] = places[std::size_t(r) - 1] + counts[std::size_t(r) - 1];
  std::vector<T> all(std::size_t(places.back() + counts.back()) / sizeof(T));
  MPI_Gatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), places.data(), MPI_BYTE, 0, comm);
  return all;
}

template <class Pairs>
void sort_pairs(Pairs& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
    return std::tuple(p.kind, p.a, p.b) < std::tuple(q.kind, q.a, q.b);
  });
}
void sort_pairs(std::vector<Intersection>& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const Intersection& p, const Intersection& q) {
    return std::tuple(p.edge, p.face) < std::tuple(q.edge, q.face);
  });
}

// The answers of one process, in the order in which they are compared: the same for every cut of a scene.
using SerialAnswers = std::vector<std::uint64_t>;

class Comparison {
 public:
  // On rank 0, `wanted` is completed where it lacks answers.
  Comparison(MPI_Comm comm, const WholeScene& scene, const std::string& where,
             const std::vector<int>& rank_of, SerialAnswers& wanted, Checks& checks)
      : comm_(comm), scene_(scene), where_(where), rank_of_(rank_of), wanted_(wanted), checks_(checks) {
    MPI_Comm_rank(comm, &rank_);
  }

  // Of a result that all ranks have: each tells rank 0 its hash.
  template <class Result, class Serial>
  void same_on_all(const char* call, const Result& result, const Serial& serial) {
    Answer mine;
    mine.add(result);
    const std::vector<std::uint64_t> hashes = gathered(comm_, std::vector<std::uint64_t>{mine.hash()});
    if (rank_ != 0) return;
    const std::uint64_t wanted = next_wanted(serial);
    for (const std::uint64_t hash : hashes) count(call, hash == wanted);
  }

  // Of a result whose pairs are spread: their union is that of one process.
  template <class Result, class Pairs, class Serial>
  void same_union(const char* call, Result result, Pairs Result::*pairs, const Serial& serial) {
    result.*pairs = gathered(comm_, result.*pairs);
    if (rank_ != 0) return;
    sort_pairs(result.*pairs);
    Answer mine;
    mine.add(result);
    count(call, mine.hash() == next_wanted(serial));
  }

  // One of the owners of a pair's primitives has it; its vertices are whose they are said to be.
  template <class Pairs>
  void owners_are_right(const Pairs& pairs, const std::vector<std::array<int, 4>>& owners) {
    std::int64_t wrong = pairs.size() != owners.size();
    for (std::size_t i = 0; i < std::min(pairs.size(), owners.size()); ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        const int v = pairs[i].vertices[k];
        wrong += owners[i][k] != (v < 0 ? -1 : rank_of_[std::size_t(v)]);
      }
    MPI_Allreduce(MPI_IN_PLACE, &wrong, 1, MPI_INT64_T, MPI_SUM, comm_);
    if (rank_ == 0) count("owners", wrong == 0);
  }

 private:
  template <class Serial>
  std::uint64_t next_wanted(const Serial& serial) {
    if (next_ == wanted_.size()) {
      Answer answer;
      answer.add(serial());
      wanted_.push_back(answer.hash());
    }
    return wanted_[next_++];
  }

  void count(const char* call, bool same) {
    ++checks_.calls;
    if (same) return;
    ++checks_.different;
    std::fprintf(stderr, "%s, %s: %s differs\n", scene_.name.c_str(), where_.c_str(), call);
  }

  MPI_Comm comm_;
  const WholeScene& scene_;
  const std::string where_;
  const std::vector<int>& rank_of_;
  SerialAnswers& wanted_;
  std::size_t next_ = 0;
  Checks& checks_;
  int rank_ = 0;
};

void check_line_search(const mpi::Mesh& mesh, const WholeScene& s, const Eigen::MatrixXd& x_t0,
                       const Eigen::MatrixXd& dx, Comparison& compare) {
  LineSearchOptions options(s.options);
  options.d_hat = s.d_hat;
  const mpi::LineSearch search(mesh, x_t0, dx, options);
  const auto serial = [&] { return LineSearch(s.mesh, s.x_t0, s.x_t1 - s.x_t0, options); };
  for (const double upper : {1.0, 0.3})
    compare.same_on_all("largest_step", search.largest_step(upper),
                        [&] { return serial().largest_step(upper); });
  for (const double step : {0.0, 0.37}) {
    const mpi::ClosePairs close = search.close_pairs(step);
    compare.owners_are_right(close.pairs, close.owners);
    compare.same_union("close_pairs of a line search", static_cast<const ClosePairs&>(close),
                       &ClosePairs::pairs, [&] { return serial().close_pairs(step); });
  }
}

void check_cut(MPI_Comm comm, const WholeScene& s, Cut cut, unsigned seed, SerialAnswers& wanted,
               Checks& checks) {
  int size = 1, rank = 0;
  MPI_Comm_size(comm, &size), MPI_Comm_rank(comm, &rank);
  const std::vector<int> rank_of = ranks_of_vertices(s, cut, size, seed);
  const mpi::MeshPart part = part_of(s, rank_of, rank);
  const Eigen::MatrixXd x_t0 = rows_of(part, s.x_t0), x_t1 = rows_of(part, s.x_t1);
  const Eigen::MatrixXd dx = rows_of(part, s.x_t1 - s.x_t0);
  const std::string where = std::string(to_string(cut)) + ", " + std::to_string(size) + " ranks";
  Comparison compare(comm, s, where, rank_of, wanted, checks);
  const mpi::Mesh mesh(comm, part);
  compare.same_on_all(
      "the mesh", mesh.num_vertices() + mesh.num_edges() * 1000 + mesh.num_faces() * 1000000, [&] {
        return std::int64_t(s.mesh.num_vertices() + s.mesh.num_edges() * 1000 + s.mesh.num_faces() * 1000000);
      });
  const StepResult step = mpi::compute_collision_free_stepsize(mesh, x_t0, x_t1, s.options);
  const auto serial_step = [&] { return compute_collision_free_stepsize(s.mesh, s.x_t0, s.x_t1, s.options); };
  compare.same_on_all("step", step, serial_step);
  compare.same_on_all("extent and tolerance", std::vector<double>{step.stats.extent, step.stats.tolerance},
                      [&] {
                        const StepResult r = serial_step();
                        return std::vector<double>{r.stats.extent, r.stats.tolerance};
                      });
  compare.same_on_all("is_step_collision_free", mpi::is_step_collision_free(mesh, x_t0, x_t1, s.options),
                      [&] { return is_step_collision_free(s.mesh, s.x_t0, s.x_t1, s.options); });
  const mpi::ActiveSet set = mpi::construct_active_set(mesh, x_t0, x_t1, s.options);
  compare.owners_are_right(set.contacts, set.owners);
  compare.same_union("active set", static_cast<const ActiveSet&>(set), &ActiveSet::contacts,
                     [&] { return construct_active_set(s.mesh, s.x_t0, s.x_t1, s.options); });
  const mpi::ClosePairs close = mpi::close_pairs(mesh, x_t0, s.d_hat, s.options);
  compare.owners_are_right(close.pairs, close.owners);
  compare.same_union("close pairs", static_cast<const ClosePairs&>(close), &ClosePairs::pairs,
                     [&] { return close_pairs(s.mesh, s.x_t0, s.d_hat, s.options); });
  Intersections at = mpi::intersections(mesh, x_t1, s.options);
  at.behind_planes = gathered(comm, at.behind_planes);
  std::sort(at.behind_planes.begin(), at.behind_planes.end());
  compare.same_union("intersections", at, &Intersections::pairs,
                     [&] { return intersections(s.mesh, s.x_t1, s.options); });
  compare.same_on_all("has_intersections", mpi::has_intersections(mesh, x_t1, s.options),
                      [&] { return has_intersections(s.mesh, s.x_t1, s.options); });
  check_line_search(mesh, s, x_t0, dx, compare);
}

}  // namespace

void check_scene(MPI_Comm comm, const WholeScene& s, unsigned seed, Checks& checks) {
  SerialAnswers wanted;
  for (const Cut cut : kCuts) check_cut(comm, s, cut, seed, wanted, checks);
}

}  // namespace onset::tests
