// onset_mpi: what `onset step` and `onset active-set` compute, over ranks.
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <onset/mpi/mpi.hpp>
#include <string>
#include <tuple>

#include "files/error.hpp"
#include "files/interrupts.hpp"
#include "files/scene/scene.hpp"
#include "mpi/partition.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/command_line/bodies.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/command_line/values.hpp"
#include "onset/results/outputs.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

struct Inputs : Arguments, BodyArguments {
  std::string a, b, partition = "rcb";
};

int rank_of_process() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

Partition to_partition(const std::string& name) {
  return name == "blocks" ? Partition::blocks : name == "random" ? Partition::random : Partition::rcb;
}

// A scene that every rank has read, and this rank's part of it.
struct ScenePart {
  std::unique_ptr<onset::mpi::Mesh> mesh;
  Eigen::MatrixXd x_t0, x_t1;
};

ScenePart cut(const Scene& scene, const std::string& partition) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const auto columns = [&](const Points& x) { return Eigen::MatrixXd(x.leftCols(scene.mesh.dimension())); };
  const Eigen::MatrixXd x_t0 = columns(scene.x_t0), x_t1 = columns(scene.x_t1);
  const std::vector<int> rank_of = ranks_of_vertices(x_t0, to_partition(partition), ranks);
  const onset::mpi::MeshPart part = part_of(scene.mesh, rank_of, rank_of_process(), true);
  return {std::make_unique<onset::mpi::Mesh>(MPI_COMM_WORLD, part), rows_of(part, x_t0), rows_of(part, x_t1)};
}

// What each rank exchanged, on rank 0, in a line each.
std::string describe_exchange(const onset::mpi::Mesh& mesh) {
  const onset::mpi::Exchange& e = mesh.exchange();
  const auto sum = [](const std::int64_t* of_kind) { return of_kind[0] + of_kind[1] + of_kind[2]; };
  const std::int64_t row[] = {sum(e.owned), sum(e.ghosts), e.bytes_sent, e.messages_sent, e.pairs};
  std::vector<std::int64_t> rows(5 * std::size_t(mesh.size()));
  MPI_Gather(row, 5, MPI_INT64_T, rows.data(), 5, MPI_INT64_T, 0, MPI_COMM_WORLD);
  std::string text;
  for (int r = 0; r < mesh.size() && mesh.rank() == 0; ++r) {
    const std::int64_t* of_rank = &rows[5 * std::size_t(r)];
    text += format("rank %d: %lld primitives, %lld ghosts, %lld bytes sent in %lld messages, %lld pairs\n", r,
                   (long long)of_rank[0], (long long)of_rank[1], (long long)of_rank[2], (long long)of_rank[3],
                   (long long)of_rank[4]);
  }
  return text;
}

// The contacts of all ranks in the order of one process, on rank 0.
void gather(onset::mpi::ActiveSet& set) {
  int ranks = 1, bytes = int(set.contacts.size() * sizeof(onset::Contact));
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<int> counts(std::size_t(ranks), 0), places(counts);
  MPI_Gather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  for (std::size_t r = 1; r < counts.size(); ++r) places[r] = places[r - 1] + counts[r - 1];
  std::vector<onset::Contact> all(std::size_t(places.back() + counts.back()) / sizeof(onset::Contact));
  MPI_Gatherv(set.contacts.data(), bytes, MPI_BYTE, all.data(), counts.data(), places.data(), MPI_BYTE, 0,
              MPI_COMM_WORLD);
  std::sort(all.begin(), all.end(), [](const onset::Pair& p, const onset::Pair& q) {
    return std::tuple(p.kind, p.a, p.b) < std::tuple(q.kind, q.a, q.b);
  });
  set.contacts = std::move(all);
}

void run(const Inputs& inputs, bool active_set) {
  const onset::Options options = to_options(inputs);
  Scene scene = read_scene(inputs.a, inputs.b);
  set_bodies(inputs, scene);
  const ScenePart part = cut(scene, inputs.partition);
  Json json;
  std::string summary = describe_sizes(scene.mesh);
  onset::mpi::ActiveSet set;
  onset::StepResult step;
  if (active_set) {
    set = onset::mpi::construct_active_set(*part.mesh, part.x_t0, part.x_t1, options);
    gather(set);
    json = active_set_json(set);
    summary += describe_active_set(set);
  } else {
    step = onset::mpi::compute_collision_free_stepsize(*part.mesh, part.x_t0, part.x_t1, options);
    json = step_json(step);
    summary += describe_step(step) + describe_stats(step.stats);
  }
  summary += describe_exchange(*part.mesh);
  if (rank_of_process() != 0) return;
  Outputs outputs(inputs, {inputs.a, inputs.b, inputs.rest});
  for (const std::string& note : scene.notes) outputs.note(note);
  if (outputs.csv())
    active_set ? write_active_set_csv(*outputs.csv(), set) : write_step_csv(*outputs.csv(), step);
  outputs.finish(json, summary);
}

CLI::App* add(CLI::App& app, Inputs& inputs, const char* name, const char* help, const char* columns) {
  CLI::App* command = app.add_subcommand(name, help);
  command->add_option("A", inputs.a, kMeshHelp)->required()->check(path_fault);
  command->add_option("B", inputs.b, kEndHelp)->required()->check(path_fault);
  command->add_option("--partition", inputs.partition, "How vertices are spread: rcb, random or blocks")
      ->check(CLI::IsMember({"rcb", "random", "blocks"}))
      ->capture_default_str();
  add_common_options(*command, inputs, columns);
  add_body_options(*command, inputs);
  return command;
}

// Every rank reads the same files and arguments, so that all fail alike, and the first one says why.
int fail(int code, const std::string& why) {
  if (rank_of_process() == 0) std::fprintf(stderr, "onset_mpi: %s\n", why.c_str());
  return code;
}

int main_of_rank(int argc, char** argv) {
  CLI::App app("The steps and active sets of onset, over ranks: mpirun -n 4 onset_mpi step A B");
  app.require_subcommand(1);
  Inputs step, set;
  CLI::App* steps = add(app, step, "step",
                        "The largest step from A towards B that is certainly free of contact", kStepColumns);
  add(app, set, "active-set", "The pairs that come into contact", kActiveSetColumns);
  try {
    app.parse(argc, argv);
    if (steps->parsed())
      run(step, false);
    else
      run(set, true);
    return kExitOk;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return rank_of_process() == 0 ? app.exit(e) : 0;
    return fail(kExitUsage, e.what());
  } catch (const std::exception& e) {
    return fail(kExitBadInput, e.what());
  }
}

}  // namespace
}  // namespace app

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int code = app::main_of_rank(argc, argv);
  MPI_Finalize();
  return code;
}
