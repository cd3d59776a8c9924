// What the machine's memory gives one thread and two: the measure of whether a stage waits for it.
//
//   onset_memory_bandwidth [MIB]
//
// Arrays of MIB (default 256, beyond any cache): copied (McCalpin's STREAM, bytes read and written, not those
// read to be overwritten), summed, and 64-byte records read at random places, whose addresses do not depend
// on each other. Best of 5, GB/s, as Markdown.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "files/text_lines.hpp"
#include "measure/timing.hpp"

namespace {

using Record = std::array<double, 8>;

struct Arrays {
  std::vector<Record> from, to;
  std::uint64_t seed = 1;
  double sum = 0;  // of what was read, so that it is read

  explicit Arrays(std::size_t bytes) : from(bytes / sizeof(Record), Record{1}), to(from) {}
};

void copy(Arrays& a) { std::copy(a.from.begin(), a.from.end(), a.to.begin()); }

void keep(Arrays& a, const Record& sum) {
  for (const double s : sum) a.sum += s;
}

void add_up(Arrays& a) {
  Record sum{};
  for (const Record& r : a.from)
    for (std::size_t i = 0; i < r.size(); ++i) sum[i] += r[i];
  keep(a, sum);
}

void gather(Arrays& a) {
  Record sum{};
  for (std::size_t k = 0; k < a.from.size(); ++k) {
    a.seed = 6364136223846793005u * a.seed + 1442695040888963407u;  // Knuth's generator
    const Record& r = a.from[std::size_t((a.seed >> 32) * a.from.size() >> 32)];
    for (std::size_t i = 0; i < r.size(); ++i) sum[i] += r[i];
  }
  keep(a, sum);
}

// Of all threads together, each with arrays of its own.
double gigabytes_a_second(std::vector<Arrays>& arrays, const std::function<void(Arrays&)>& work,
                          double bytes_a_record) {
  double least = INFINITY;
  for (int round = 0; round < 5; ++round) {
    const app::Stopwatch watch;
    std::vector<std::thread> threads;
    for (Arrays& a : arrays) threads.emplace_back(work, std::ref(a));
    for (std::thread& t : threads) t.join();
    least = std::min(least, watch.elapsed().wall);
  }
  return 1e-9 * bytes_a_record * double(arrays.size() * arrays[0].from.size()) / least;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::int64_t kMost = 1 << 20;
  const std::optional<std::int64_t> mebibytes = argc > 1 ? app::parse_whole(argv[1]) : 256;
  if (!mebibytes || *mebibytes < 1 || *mebibytes > kMost) {
    std::fprintf(stderr, "usage: onset_memory_bandwidth [MIB]\n");
    return 2;
  }
  std::printf(
      "| threads | copied, GB/s | summed, GB/s | 64 bytes at random, GB/s | ns a record "
      "|\n|---|---|---|---|---|\n");
  double sum = 0;
  for (std::size_t threads = 1; threads <= 2; ++threads) {
    std::vector<Arrays> arrays(threads, Arrays(std::size_t(*mebibytes) << 20));
    const double size = sizeof(Record), random = gigabytes_a_second(arrays, gather, size);
    std::printf("| %zu | %.1f | %.1f | %.1f | %.2f |\n", threads, gigabytes_a_second(arrays, copy, 2 * size),
                gigabytes_a_second(arrays, add_up, size), random, size * double(threads) / random);
    for (const Arrays& a : arrays) sum += a.sum;
  }
  return sum > 0 ? 0 : 1;
}
