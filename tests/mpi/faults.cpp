#include "tests/mpi/faults.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <new>
#include <onset/mpi/mpi.hpp>
#include <random>
#include <stdexcept>

#include "tests/mpi/generated.hpp"
#include "tests/mpi/memory.hpp"
#include "tests/src/support/answer.hpp"

namespace onset::tests {
namespace {

enum class Fault {
  none,
  not_a_number,
  infinite,
  wrong_rows,
  bad_option,
  other_option,
  cancelled,
  throws,
  out_of_time,
  out_of_memory,
  no_memory,
  other_rules,
  bad_id,
  lost_face,
  huge_face_id,
  used_point,
  other_call,
  last = other_call
};
const char* to_string(Fault fault) {
  constexpr const char* kNames[] = {"none",           "NaN",
                                    "infinity",       "wrong number of rows",
                                    "bad option",     "other option",
                                    "cancel",         "throw",
                                    "time limit",     "memory limit",
                                    "bad_alloc",      "other rules",
                                    "bad vertex id",  "a face that nobody has",
                                    "a huge face id", "a point of a face",
                                    "another call"};
  return kNames[int(fault)];
}

// How a call ended, as a number: what it threw, or its outcome.
struct End {
  std::int64_t threw = 0, outcome = 0, text = 0;
  bool operator==(const End& o) const { return threw == o.threw && outcome == o.outcome && text == o.text; }
};

struct Case {
  Fault fault;
  int call, rank;
  long when;  // of no_memory: which allocation; of cancelled and throws: which report
};

void change_part(const Case& c, mpi::MeshPart& part) {
  if (c.fault == Fault::other_rules) part.rules.weld = !part.rules.weld;
  if (c.fault == Fault::bad_id && !part.vertex_ids.empty())  // an owned one, or a ghost where there is any
    (c.when % 4 < 2 ? part.vertex_ids.front() : part.vertex_ids.back()) = c.when % 2 ? 1 << 20 : -3;
  if (c.fault == Fault::huge_face_id && !part.face_ids.empty()) part.face_ids.back() = 2000000000;
  if (c.fault == Fault::lost_face && !part.face_ids.empty()) part.face_ids[0] += 1000;
  if (c.fault == Fault::used_point && part.faces.rows() > 0)
    part.rules.points = {int(part.faces(0, 0))}, part.point_ids = {0};
}

void change_positions(const Case& c, const mpi::MeshPart& part, Eigen::MatrixXd& x) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (part.owned > 0 && c.fault == Fault::not_a_number)
    x(c.when % part.owned, c.when % 3) = std::numeric_limits<double>::quiet_NaN();
  if (part.owned > 0 && c.fault == Fault::infinite) x(c.when % part.owned, c.when % 3) = kInfinity;
  if (c.fault == Fault::wrong_rows) x = Eigen::MatrixXd::Zero(x.rows() + 1, 3);
}

void change_options(const Case& c, Options& o) {
  if (c.fault == Fault::bad_option) o.min_separation = -1;
  if (c.fault == Fault::other_option) o.min_separation = 0.25;
  if (c.fault == Fault::out_of_time) o.time_limit = 0;
  if (c.fault == Fault::out_of_memory) o.memory_limit = 300;
  if (c.fault != Fault::cancelled && c.fault != Fault::throws) return;
  o.progress = [left = c.when % 6, throws = c.fault == Fault::throws](double) mutable {
    if (left-- > 0) return true;
    if (throws) throw std::runtime_error("the host has had enough");
    return false;
  };
}

Outcome run(MPI_Comm comm, const Case& c, const mpi::MeshPart& part, const Eigen::MatrixXd& x_t0,
            const Eigen::MatrixXd& x_t1, const Options& options, bool faulty) {
  const bool fails = faulty && c.fault == Fault::no_memory;
  if (fails && c.when % 2 == 1) fail_at_allocation(1 + c.when / 2);
  const mpi::Mesh mesh(comm, part);
  if (fails && c.when % 2 == 0) fail_at_allocation(1 + c.when / 2);
  switch (faulty && c.fault == Fault::other_call ? (c.call + 1) % 6 : c.call) {
    case 0:
      return mpi::compute_collision_free_stepsize(mesh, x_t0, x_t1, options).outcome;
    case 1:
      return mpi::is_step_collision_free(mesh, x_t0, x_t1, options) ? Outcome::free : Outcome::contact;
    case 2:
      return mpi::construct_active_set(mesh, x_t0, x_t1, options).outcome;
    case 3:
      return mpi::close_pairs(mesh, x_t1, 0.05, options).outcome;
    case 4:
      return mpi::intersections(mesh, x_t1, options).outcome;
    default: {
      const mpi::LineSearch search(mesh, x_t0, x_t1, options);
      return search.largest_step().outcome;
    }
  }
}

End end_of(MPI_Comm comm, const Case& c, mpi::MeshPart part, Eigen::MatrixXd x_t0, Eigen::MatrixXd x_t1,
           Options options, bool faulty) {
  if (faulty) change_part(c, part), change_positions(c, part, x_t1), change_options(c, options);
  End end;
  const auto note = [&](int threw, const char* text) {
    Answer hash;
    hash.add(text);
    end.threw = threw, end.text = std::int64_t(hash.hash());
  };
  try {
    end.outcome = std::int64_t(run(comm, c, part, x_t0, x_t1, options, faulty));
  } catch (const std::bad_alloc&) {
    note(1, "");
  } catch (const std::invalid_argument& e) {
    note(2, e.what());
  } catch (const std::logic_error& e) {
    note(3, e.what());
  } catch (const std::exception& e) {
    note(4, e.what());
  }
  fail_at_allocation(0);
  return end;
}

// In seconds.
constexpr double kLongest = 1;
// Where ranks share cores, or other programs have them, a call may be slow once.
constexpr int kTries = 3;

// How a fault ended, on all ranks.
struct Ended {
  End end;
  bool alike = true;
  double seconds = 0;  // of the slowest rank
};

Ended inject(MPI_Comm comm, int i, const Case& c) {
  int size = 1, rank = 0;
  MPI_Comm_size(comm, &size), MPI_Comm_rank(comm, &rank);
  const int round = i / int(Fault::last);  // each fault meets all scenes and cuts in turn
  const WholeScene scene = generated(round % 3 == 0 ? 6 : round % 3 == 1 ? 2 : 7);
  const std::vector<int> rank_of = ranks_of_vertices(scene, kCuts[round % 5], size, unsigned(i));
  const mpi::MeshPart part = part_of(scene, rank_of, rank);
  const Eigen::MatrixXd x_t0 = rows_of(part, scene.x_t0), x_t1 = rows_of(part, scene.x_t1);
  Ended r;
  for (int tries = 0; tries < kTries; ++tries) {
    MPI_Barrier(comm);
    const double begun = MPI_Wtime();
    r.end = end_of(comm, c, part, x_t0, x_t1, scene.options, rank == c.rank);
    r.seconds = MPI_Wtime() - begun;
    End first = r.end;
    MPI_Bcast(&first, int(sizeof first), MPI_BYTE, 0, comm);
    std::int64_t different = !(first == r.end);
    MPI_Allreduce(MPI_IN_PLACE, &different, 1, MPI_INT64_T, MPI_MAX, comm);
    MPI_Allreduce(MPI_IN_PLACE, &r.seconds, 1, MPI_DOUBLE, MPI_MAX, comm);
    r.alike = r.alike && different == 0;
    if (r.seconds < kLongest) break;
  }
  return r;
}

}  // namespace

void inject_faults(MPI_Comm comm, int count, Checks& checks) {
  int size = 1, rank = 0;
  MPI_Comm_size(comm, &size), MPI_Comm_rank(comm, &rank);
  std::mt19937 random(5);
  long ended[int(Fault::last) + 1][2] = {};
  double slowest = 0;
  for (int i = 0; i < count; ++i) {
    const Case c{Fault(1 + i % int(Fault::last)), int(random() % 6), int(random() % unsigned(size)),
                 long(random() % 2000)};
    const Ended r = inject(comm, i, c);
    slowest = std::max(slowest, r.seconds);
    ++ended[int(c.fault)][r.end.threw != 0];
    if (rank != 0) continue;
    ++checks.calls;
    if (r.alike && r.seconds < kLongest) continue;
    ++checks.different;
    std::fprintf(stderr, "fault %d (%s on rank %d of call %d): %s, %.2f s\n", i, to_string(c.fault), c.rank,
                 c.call, r.alike ? "slow" : "ranks ended differently", r.seconds);
  }
  if (rank != 0) return;
  for (int f = 1; f <= int(Fault::last); ++f)
    std::printf("  %-24s %4ld ended with an outcome, %4ld with an exception\n", to_string(Fault(f)),
                ended[f][0], ended[f][1]);
  std::printf("  slowest %.3f s\n", slowest);
}

}  // namespace onset::tests
