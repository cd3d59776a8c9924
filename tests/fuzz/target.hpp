// One kind of input that fuzzing makes: each target is a file that defines these, for libFuzzer and for the
// replay.
#pragma once

#include <cstdint>
#include <string>

#include "tests/scenes/random.hpp"

namespace onset::fuzz {

extern const char* const kTarget;
// How many inputs a test tries, unless it is told.
extern const int kInputs;

// Empty, or what is broken and by which input.
std::string run_target(const std::uint8_t* data, std::size_t size);

// The i-th input to start from.
std::string make_seed(int i, scenes::Random& random);

}  // namespace onset::fuzz
