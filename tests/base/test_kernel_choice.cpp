// A kernel is chosen by request, by the environment or by what the machine has; the environment is read once.
//   test_kernel_choice WORD    with ONSET_KERNEL=WORD in the environment, or none for "none"
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/instruction_set.hpp"

using onset::InstructionSet;

namespace {

int failures = 0;

void check(bool holds, const char* what) {
  if (holds) return;
  ++failures;
  std::fprintf(stderr, "failed: %s\n", what);
}

// The answer for automatic in words, or what was thrown.
std::string chosen() {
  try {
    return onset::to_string(onset::resolve_instruction_set(InstructionSet::automatic));
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
}

}  // namespace

int main(int, char** argv) {
  const std::string word = argv[1];
  if (word == "none") unsetenv("ONSET_KERNEL");
  const bool avx2 = onset::has_avx2(), avx512 = onset::has_avx512();
  check(avx2 || !avx512, "no AVX-512 without AVX2");
  check(avx512 || !onset::prefers_avx512(), "nothing is preferred that is not there");
  check(onset::resolve_instruction_set(InstructionSet::scalar) == InstructionSet::scalar,
        "scalar on request");
  const std::string first = chosen();
  if (word == "scalar")
    check(first == "scalar", "scalar by the environment");
  else if (word == "sse9")
    check(first.find("sse9") != std::string::npos, "another word throws and is named");
  else if ((word == "avx2" && !avx2) || (word == "avx512" && !avx512))
    check(first.find(word + ": not supported") != std::string::npos, "a set that is not there throws");
  else if (word == "avx2" || word == "avx512")
    check(first == word, "by the environment");
  else
    check(first == (onset::prefers_avx512() ? "avx512" : avx2 ? "avx2" : "scalar"), "the best that there is");
  check(std::string(onset::to_string(InstructionSet::avx2)) == "avx2", "its name");
  check(std::string(onset::to_string(InstructionSet::avx512)) == "avx512", "its name");
  check(std::string(onset::to_string(InstructionSet::automatic)) == "automatic",
        "the name of what is not chosen yet");
  try {
    onset::resolve_instruction_set(InstructionSet(7));
    check(false, "a number that names no set throws");
  } catch (const std::invalid_argument& e) {
    check(std::string(e.what()) == "instruction set 7: unknown", "a number that names no set is named");
  }

  setenv("ONSET_KERNEL", word == "scalar" ? "avx2" : "scalar", 1);
  std::vector<std::thread> threads;
  std::vector<std::string> later(4);
  for (std::string& answer : later) threads.emplace_back([&answer] { answer = chosen(); });
  for (std::thread& t : threads) t.join();
  for (const std::string& answer : later) check(answer == first, "what is set later changes nothing");
  check(onset::resolve_instruction_set(InstructionSet::scalar) == InstructionSet::scalar, "still on request");
  return failures == 0 ? 0 : 1;
}
