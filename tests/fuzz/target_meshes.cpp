// Whole meshes with rules, options and positions from bytes: by every method, against exact truth.
#include <exception>

#include "tests/fuzz/mesh_truth.hpp"
#include "tests/fuzz/target.hpp"

namespace onset::fuzz {

const char* const kTarget = "meshes";
const int kInputs = 2000;

static std::string check_mesh(const MeshInput& input, Bytes& bytes) {
  // What is dear is done for some; not where the bytes have ended.
  int part = 0, cancel_after = 0;
  bytes.whole(part, 0, 31);
  if (!input.is_usable()) return broken_by_bad_positions(input);
  if (std::string broken = broken_by_methods(input); !broken.empty()) return broken;
  if (std::string broken = broken_by_integers(input); !broken.empty()) return broken;
  if (part == 1) return broken_by_rationals(input);
  if (part == 0 || part > 6) return {};
  std::int64_t check_limit = 0, memory_limit = 0;
  const std::int64_t most = Options().check_limit;
  const std::int64_t limits[] = {most, most, most, 0, 1, 5, 30, 200},
                     sizes[] = {most, most, 0, 8, 88, 256, 600, 3000};
  bytes.one_of(check_limit, limits), bytes.one_of(memory_limit, sizes), bytes.whole(cancel_after, 0, 7);
  return broken_by_budgets(input, check_limit, memory_limit, cancel_after);
}

std::string run_target(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const MeshInput input = read_mesh_input(bytes);
  std::string broken;
  try {
    broken = check_mesh(input, bytes);
  } catch (const std::exception& e) {
    broken = std::string("throws ") + e.what();
  }
  return broken.empty() ? broken : broken + "\n" + to_text(input);
}

std::string make_seed(int, scenes::Random& random) {
  std::string seed = seed_of_scene(random);
  for (int i = scenes::integer(random, 0, 120); i > 0; --i) seed += char(random());
  return seed;
}

}  // namespace onset::fuzz
