// How often single queries of all families, as they are and changed at random, are missed, late or wrong:
//   onset_count_queries [QUERIES] [THREADS] [SEED] [SAMPLE]      default: 1,000,000 on one thread from seed
//   1, 10,000
// Each is asked with options of its own and compared with the integers; one of SAMPLE with the rational
// oracle too, with what the result says about itself, and with its separation. The exit status is 1 where
// anything is broken.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/fuzz/query_input.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;
using namespace onset::fuzz;

namespace {

constexpr std::int64_t kChunk = 1 << 16;
constexpr std::int64_t kTold = 20;  // broken queries that are printed

struct Counts {
  std::int64_t queries = 0, changed = 0, sampled = 0, broken[kBrokenKinds] = {};
  void add(const Counts& c) {
    queries += c.queries, changed += c.changed, sampled += c.sampled;
    for (int i = 0; i < kBrokenKinds; ++i) broken[i] += c.broken[i];
  }
  std::int64_t wrong() const {
    std::int64_t sum = 0;
    for (int i = 1; i < kBrokenKinds; ++i) sum += broken[i];
    return sum;
  }
};

std::mutex mutex;

// In turn; that of magnitudes 1e-30 to 1e30, whose integers are so long that it would take a third of the
// time, in one round of sixteen.
const scenes::Family& pick(const std::vector<scenes::Family>& families, std::int64_t i) {
  const std::size_t n = families.size(), k = std::size_t(i) % n;
  const bool dear = std::string(families[k].name) == "mixed_magnitudes" && std::size_t(i) / n % 16 != 0;
  return families[dear ? (k + 1 + std::size_t(i) / n) % n : k];
}

// Of seeds of its own, so that the threads do not matter.
Counts count_chunk(std::int64_t chunk, std::int64_t count, std::uint64_t seed, std::int64_t every) {
  Counts c;
  const auto& families = scenes::families();
  scenes::Random random(seed * 0x9e3779b97f4a7c15u + std::uint64_t(chunk));
  for (std::int64_t i = 0; i < count; ++i) {
    const scenes::Family& family = pick(families, i);
    const PairKind kind = scenes::coin(random) ? PairKind::vertex_face : PairKind::edge_edge;
    QueryInput input;
    input.query = family.make(kind, random);
    const bool changes = scenes::coin(random);
    if (changes) change(input.query, random);
    input.options = random_query_options(input.query, random);
    const bool sample = (chunk * kChunk + i) % every == 0;
    std::string why;
    const Broken broken = sample ? check_fully(input, why) : check_quickly(input);
    ++c.queries, c.changed += changes, c.sampled += sample, ++c.broken[int(broken)];
    if (broken == Broken::none) continue;
    const std::lock_guard lock(mutex);
    static std::int64_t told = 0;
    if (++told <= kTold)
      std::printf("%s: %s %s %s\n", name(broken), family.name, to_text(input).c_str(), why.c_str());
  }
  return c;
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t queries = argc > 1 ? std::atoll(argv[1]) : 1'000'000;
  const int threads = argc > 2 ? std::atoi(argv[2]) : 1;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  const std::int64_t every = argc > 4 ? std::max(1LL, std::atoll(argv[4])) : 10'000;
  std::atomic<std::int64_t> next{0};
  Counts all;
  std::vector<std::thread> workers;
  for (int t = 0; t < std::max(threads, 1); ++t)
    workers.emplace_back([&] {
      for (std::int64_t chunk; (chunk = next++) * kChunk < queries;) {
        const Counts c = count_chunk(chunk, std::min(kChunk, queries - chunk * kChunk), seed, every);
        const std::lock_guard lock(mutex);
        all.add(c);
        if (all.queries / 10'000'000 != (all.queries - c.queries) / 10'000'000)
          std::printf("... %lld queries, %lld broken\n", static_cast<long long>(all.queries),
                      static_cast<long long>(all.wrong())),
              std::fflush(stdout);
      }
    });
  for (std::thread& worker : workers) worker.join();
  std::printf(
      "%lld queries of %zu families, %lld of them changed at random, %lld also against the rational oracle:",
      static_cast<long long>(all.queries), scenes::families().size(), static_cast<long long>(all.changed),
      static_cast<long long>(all.sampled));
  for (int i = 1; i < kBrokenKinds; ++i)
    std::printf("%s %lld %s", i > 1 ? "," : "", static_cast<long long>(all.broken[i]), name(Broken(i)));
  std::printf("\n");
  return all.wrong() > 0;
}
