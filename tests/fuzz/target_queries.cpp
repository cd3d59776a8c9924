// Single queries with every option that they heed, from bytes, against the integers and the rational oracle.
#include <exception>

#include "tests/fuzz/query_input.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/scenes/families.hpp"

namespace onset::fuzz {

const char* const kTarget = "queries";
const int kInputs = 5000;

std::string run_target(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  QueryInput input;
  describe(bytes, input);
  std::string why;
  Broken broken = Broken::none;
  try {
    // The bytes behind say which are asked the rational oracle: one of 16.
    int part = 0;
    bytes.whole(part, 0, 15);
    broken = part == 1 ? check_fully(input, why) : check_quickly(input);
  } catch (const std::exception& e) {
    return std::string("throws ") + e.what() + ": " + to_text(input);
  }
  return broken == Broken::none ? std::string()
                                : std::string(name(broken)) + ": " + to_text(input) + " " + why;
}

std::string make_seed(int i, scenes::Random& random) {
  const auto& families = scenes::families();
  QueryInput input;
  input.query = families[std::size_t(i) % families.size()].make(
      scenes::coin(random) ? PairKind::vertex_face : PairKind::edge_edge, random);
  input.options = random_query_options(input.query, random);
  Bytes bytes;
  describe(bytes, input);
  return bytes.written() + char(random());
}

}  // namespace onset::fuzz
