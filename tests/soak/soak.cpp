// A run of many steps, as of a process that lives for months: memory and handles stay, no call grows slower,
// nothing ever intersects, and the same bytes come out each time, for any number of threads.
//
//   soak [STEPS]      10000 by default, a multiple of 1000, 2000 at least; of each of four runs. Ends with 1
//                     where anything is not so.
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/faults/allocations.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/soak/cloth.hpp"
#include "tests/soak/other_process.hpp"
#include "tests/soak/process.hpp"
#include "tests/soak/timing.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Steps after which all must have settled.
constexpr std::int64_t kWarm = 1000;
// What an allocator may still take on for fragments, beyond what later lives hold more of at once than the
// first ones; a leak of 11 bytes a step is more in 100,000 steps.
constexpr std::int64_t kMiB = 1 << 20, kFlat = kMiB;

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

int failures = 0;
bool expect(bool holds, const char* what) {
  if (!holds) ++failures, std::printf("FAILED: %s\n", what);
  return holds;
}

// The most of what the system says, while warming up and after.
class Most {
 public:
  void look(bool warm) {
    at(bytes_, warm, resident_bytes()), at(files_, warm, open_files()), at(threads_, warm, threads_alive());
    at(held_, warm, most_bytes_since());
  }
  void print_and_check() const {
    std::printf("  resident %.2f MiB after %" PRId64 " steps, %.2f MiB at most after; %" PRId64
                " and %" PRId64 " files; %" PRId64 " and %" PRId64 " threads\n",
                double(bytes_[0]) / kMiB, kWarm, double(bytes_[1]) / kMiB, files_[0], files_[1], threads_[0],
                threads_[1]);
    std::printf("  %.2f MiB held at once in these steps, %.2f MiB at most after\n", double(held_[0]) / kMiB,
                double(held_[1]) / kMiB);
    const std::int64_t more = std::max<std::int64_t>(held_[1] - held_[0], 0);
    expect(bytes_[0] > 0 && bytes_[1] - bytes_[0] <= kFlat + more, "resident memory grows");
    expect(files_[1] <= files_[0], "open files grow");
    expect(threads_[1] <= threads_[0], "threads grow");
  }

 private:
  using Two = std::array<std::int64_t, 2>;
  static void at(Two& most, bool warm, std::int64_t now) { most[warm] = std::max(most[warm], now); }
  Two bytes_{}, held_{}, files_{}, threads_{};
};

// The lives of one tenth of a run. In the last one they are those of the first: what they answer must be the
// same.
struct Part {
  std::int64_t lives = 0, life = 0;
  int tenth() const { return int(10 * life / lives); }
  std::uint64_t seed() const { return std::uint64_t(1 + (tenth() == 9 ? life - 9 * lives / 10 : life)); }
};

std::vector<std::uint64_t> hashes_of_lives;  // of the first run

struct Run {
  const char* name;
  int (*threads)(int step);
};
constexpr Run kRuns[] = {{"the caller's threads", [](int) { return 0; }},
                         {"1 thread", [](int) { return 1; }},
                         {"2 threads", [](int) { return 2; }},
                         {"2, 0 and 1 threads in turns", [](int step) { return (2 + step) % 3; }}};

void add(const Cloth::Tally& from, Cloth::Tally& to) {
  to.steps += from.steps, to.moved += from.moved, to.limited += from.limited;
  to.close_pairs += from.close_pairs, to.contacts += from.contacts, to.intersecting += from.intersecting;
}

struct Timed {
  Asked asked;
  double seconds;
};

// Runs one life, and returns the hash of its answers. `each` is told of each call, and look of what is left.
template <class Each, class Look>
std::uint64_t live(const Run& run, std::uint64_t seed, const Each& each, const Look& look) {
  const Cloth::Timed timed = [&](Asked asked, double seconds) { each(Timed{asked, seconds}); };
  Cloth cloth(seed, timed);
  Answer answer;
  for (int i = 0; i < Cloth::kLife; ++i) cloth.step(run.threads(i), answer);
  look(cloth);
  return answer.hash();
}

// What another process of this program is for: it lives the lives that it is told the seeds of, and says what
// each call took.
int live_when_told(const Run& run) {
  std::uint64_t seed;
  while (read_all(STDIN_FILENO, &seed, sizeof seed)) {
    std::vector<Timed> calls;
    live(
        run, seed, [&](const Timed& t) { calls.push_back(t); }, [](const Cloth&) {});
    const std::uint64_t count = calls.size();
    if (!write_all(STDOUT_FILENO, &count, sizeof count) ||
        !write_all(STDOUT_FILENO, calls.data(), count * sizeof(Timed)))
      return 1;
  }
  return 0;
}

// The other side of it. It is begun before anything is measured, and lives when this process is old.
class Young {
 public:
  explicit Young(const Run& run)
      : name_(std::to_string(&run - kRuns)), process_({"--when-told", name_.c_str()}) {}
  // Returns whether it did.
  bool live(std::uint64_t seed, Durations& durations) {
    std::uint64_t count = 0;
    if (!process_.tell(&seed, sizeof seed) || !process_.hear(&count, sizeof count) || count > most_.size())
      return false;
    if (!process_.hear(most_.data(), count * sizeof(Timed))) return false;
    for (std::size_t i = 0; i < count; ++i) durations.add(most_[i].asked, most_[i].seconds);
    return true;
  }

 private:
  const std::string name_;
  OtherProcess process_;
  std::vector<Timed> most_ = std::vector<Timed>(std::size_t(kAsked) * 10 * Cloth::kLife);
};

void check_times(const Durations& old, const Durations& young) {
  std::printf("  CPU time by that of a process that has just begun, of medians and of the same calls:");
  bool slower = false;
  for (int k = 0; k < kAsked; ++k) {
    const double medians = old.ratio_of_medians(Asked(k), young);
    const double same = old.median_of_ratios(Asked(k), young);
    if (medians == 0) continue;
    std::printf(" %s %.3f %.3f;", name(Asked(k)), medians, same);
    slower = slower || (medians > kNoise && same > kNoise);
  }
  std::printf("\n");
  expect(!slower, "a call grows slower");
}

void soak(const Run& run, std::int64_t steps) {
  const std::int64_t lives = steps / Cloth::kLife;
  const auto samples = std::size_t(steps / 10 + Cloth::kLife);
  Durations old_one(samples), young_one(samples);
  Young young(run);
  Most most;
  Cloth::Tally tally;
  int crossed = 0, other_bytes = 0, again_other = 0;
  std::int64_t blocks = -1, blocks_grew = 0;
  const bool is_first = &run == kRuns;
  if (is_first) hashes_of_lives.assign(std::size_t(lives), 0);
  Answer all;
  for (Part part{lives, 0}; part.life < lives; ++part.life) {
    const bool last = part.tenth() == 9;
    if (last) expect(young.live(part.seed(), young_one), "the other process has ended");
    const std::uint64_t hash = live(
        run, part.seed(),
        [&](const Timed& t) {
          if (last) old_one.add(t.asked, t.seconds);
        },
        [&](const Cloth& cloth) {
          add(cloth.tally(), tally);
          most.look(part.life * Cloth::kLife >= kWarm);
          if (is_first) crossed += cloth.exact_intersections();
        });
    all.add(hash);
    std::uint64_t& expected = hashes_of_lives[std::size_t(part.life)];
    if (is_first) expected = hash;
    other_bytes += hash != expected;
    again_other += hash != hashes_of_lives[std::size_t(part.seed() - 1)];
    if (part.life * Cloth::kLife < kWarm)
      blocks = live_blocks();
    else
      blocks_grew = std::max(blocks_grew, live_blocks() - blocks);
  }
  std::printf(
      "%s: %" PRId64 " steps, %.1f %% moved, %.1f %% limited, %.1f close pairs and %.1f contacts each\n",
      run.name, tally.steps, 100.0 * double(tally.moved) / double(tally.steps),
      100.0 * double(tally.limited) / double(tally.steps), double(tally.close_pairs) / double(tally.steps),
      5.0 * double(tally.contacts) / double(tally.steps));
  std::printf("  bytes %016" PRIx64 "; %" PRId64
              " steps ended with intersections, %d found by rational arithmetic\n",
              all.hash(), tally.intersecting, crossed);
  most.print_and_check();
  std::printf("  blocks of memory more than after %" PRId64 " steps: %" PRId64 "\n", kWarm, blocks_grew);
  check_times(old_one, young_one);
  expect(tally.moved > tally.steps / 2 && tally.limited > tally.steps / 10 && tally.contacts > 0,
         "too little happens in this run");
  expect(tally.intersecting == 0 && crossed == 0, "the sheets intersect");
  expect(blocks_grew == 0, "blocks of memory are not given back");
  expect(other_bytes == 0, "other bytes than with other numbers of threads");
  expect(again_other == 0, "other bytes when the same is done again");
}

// The same call, again and again: what a call leaves behind shows soonest.
void repeat_call(int threads) {
  constexpr int kCalls = 10000;
  const scenes::Scene scene = scenes::sphere_onto_sphere(8, 12, 0.01, 0.5);
  const Mesh mesh(scene.x_t0, scene.faces);
  Options options;
  options.threads = threads;
  Most most;
  for (int i = 0; i < kCalls; ++i) {
    compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1, options);
    if (i % 10 == 9) most.look(i >= kWarm);
  }
  std::printf("%d calls with %d threads:\n", kCalls, threads);
  most.print_and_check();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::string(argv[1]) == "--when-told") return live_when_told(kRuns[std::atoi(argv[2])]);
  const std::int64_t steps = argc > 1 ? std::atoll(argv[1]) : 10000;
  constexpr std::int64_t kTenLives = 10 * Cloth::kLife;
  if (steps < 2 * kWarm || steps % kTenLives != 0) {
    std::fprintf(stderr,
                 "soak: STEPS has to be a multiple of %" PRId64 ", and %" PRId64
                 " at least: what follows is held against the first %" PRId64 "\n",
                 kTenLives, 2 * kWarm, kWarm);
    return 2;
  }
  for (const int threads : {2, 4}) repeat_call(threads);
  for (const Run& run : kRuns) soak(run, steps);
  std::printf(failures == 0 ? "soak: all is as it was\n" : "soak: %d failures\n", failures);
  return failures == 0 ? 0 : 1;
}
