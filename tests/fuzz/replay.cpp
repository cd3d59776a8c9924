// A target as a program of its own, for any compiler. Inputs are seeds, as they are and damaged, the same
// ones each time:
//   fuzz_TARGET [INPUTS] [SEED]         tries them, and prints how many were broken
//   fuzz_TARGET --seeds FOLDER [COUNT]  writes seeds, for libFuzzer to start from
//   fuzz_TARGET --files FILE...         tries files, as libFuzzer leaves them
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "tests/fuzz.hpp"
#include "tests/fuzz/target.hpp"

using namespace onset;
using namespace onset::fuzz;

namespace {

constexpr int kTold = 5;

bool passes(const std::string& input, const std::string& name) {
  const std::string broken = run_target(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  static int told = 0;
  if (!broken.empty() && ++told <= kTold) std::printf("%s, %s: %s\n", kTarget, name.c_str(), broken.c_str());
  return broken.empty();
}

// Bytes turned, copied, lost, made equal, or numbers next to them.
void damage(std::string& bytes, scenes::Random& random) {
  const auto below = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
  if (bytes.empty()) bytes += char(random());
  const std::size_t at = below(bytes.size()), length = std::min(1 + below(9), bytes.size() - at);
  switch (below(6)) {
    case 0:
      bytes[at] = char(random());
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2: {  // drawn in this order by every compiler
      const std::size_t count = 1 + below(40), from = below(bytes.size());
      bytes.insert(at, bytes.substr(from, count));
      break;
    }
    case 3:
      bytes[at] = char(bytes[at] + (scenes::coin(random) ? 1 : -1));
      break;
    case 4:
      for (std::size_t i = 0; i < length; ++i) bytes[at + i] = bytes[below(bytes.size())];
      break;
    default: {
      const std::string piece = bytes.substr(below(bytes.size()), 8);
      bytes.replace(at, std::min(piece.size(), bytes.size() - at), piece);
      break;
    }
  }
}

std::string input(int i, std::uint64_t seed) {
  scenes::Random random(seed * 1000003 + std::uint64_t(i));
  std::string bytes = make_seed(i, random);
  if (i % 3 != 0)
    for (int times = scenes::integer(random, 1, 6); times > 0; --times) damage(bytes, random);
  return bytes;
}

int write_seeds(const std::string& folder, int count) {
  for (int i = 0; i < count; ++i) {
    scenes::Random random(std::uint64_t(i) + 1);
    std::ofstream file(folder + "/seed_" + std::to_string(i), std::ios::binary);
    const std::string seed = make_seed(i, random);
    if (!file.write(seed.data(), std::streamsize(seed.size()))) {
      std::fprintf(stderr, "cannot write into %s\n", folder.c_str());
      return 2;
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "--seeds" && argc > 2) return write_seeds(argv[2], argc > 3 ? std::atoi(argv[3]) : 300);
  int broken = 0;
  if (first == "--files") {
    for (int i = 2; i < argc; ++i) {
      std::ifstream file(argv[i], std::ios::binary);
      broken += !passes({std::istreambuf_iterator<char>(file), {}}, argv[i]);
    }
    std::printf("%s: %d files, %d broken\n", kTarget, argc - 2, broken);
    return broken > 0;
  }
  const int inputs = argc > 1 ? std::atoi(argv[1]) : tests::fuzz(kInputs);
  const char* of_environment = std::getenv("ONSET_SEED");
  const std::uint64_t seed = std::strtoull(argc > 2         ? argv[2]
                                           : of_environment ? of_environment
                                                            : "1",
                                           nullptr, 10);
  for (int i = 0; i < inputs; ++i) broken += !passes(input(i, seed), "input " + std::to_string(i));
  std::printf("%s: %d inputs of seed %llu, %d broken\n", kTarget, inputs,
              static_cast<unsigned long long>(seed), broken);
  return broken > 0;
}
