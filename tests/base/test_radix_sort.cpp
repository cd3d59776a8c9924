#include <algorithm>

#include "base/parallel_radix_sort.hpp"
#include "tests/asks.hpp"
#include "tests/catch.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;

namespace {

struct Item {
  std::uint64_t key;
  int place;
  bool operator==(const Item& o) const { return key == o.key && place == o.place; }
};

// Keys that differ in the bits of `mask` only.
std::vector<Item> items(int count, std::uint64_t mask, scenes::Random& random) {
  std::vector<Item> r;
  for (int i = 0; i < count; ++i) {
    const auto half = [&] { return std::uint64_t(std::uint32_t(scenes::integer(random, 0, 0x7fffffff))); };
    r.push_back({((half() << 33 ^ half() << 11 ^ half()) & mask) | (~mask & 0x5555555555555555), i});
  }
  return r;
}

}  // namespace

TEST_CASE("sorting by digits is stable and orders whole keys", "[unit]") {
  scenes::Random random(7);
  for (const std::uint64_t mask :
       {std::uint64_t(0), std::uint64_t(1), std::uint64_t(1) << 63, ~std::uint64_t(0),
        std::uint64_t(0x8003ffff0003ffff), std::uint64_t(0x00000000000ff800)})
    for (const int count : {0, 1, 2, 3, 1000, 5000}) {
      std::vector<Item> mine = items(count, mask, random), theirs = mine;
      radix_sort(mine, [](const Item& x) { return x.key; });
      std::stable_sort(theirs.begin(), theirs.end(),
                       [](const Item& x, const Item& y) { return x.key < y.key; });
      CAPTURE(mask, count);
      CHECK((mine == theirs));
    }
}

TEST_CASE("sorting by digits can be stopped wherever it asks, once in so many items", "[unit]") {
  scenes::Random random(8);
  const int count = 100000;
  const auto key = [](const Item& x) { return x.key; };
  std::vector<Item> all = items(count, ~std::uint64_t(0), random);
  tests::Asks asks;
  REQUIRE(radix_sort(all, key, asks.stop()));
  CHECK(std::is_sorted(all.begin(), all.end(), [](const Item& x, const Item& y) { return x.key < y.key; }));
  CHECK(asks.count >= 13 * (count / std::int64_t(kItemsALook)));  // one round, and two for each of six digits
  for (std::int64_t n = 0; n < asks.count; ++n) {
    tests::Asks some(n);
    std::vector<Item> lost = items(count, ~std::uint64_t(0), random);
    CHECK_FALSE(radix_sort(lost, key, some.stop()));
    CHECK(some.count == n + 1);
  }
}

TEST_CASE("sorting by digits with more threads gives the same", "[unit]") {
  scenes::Random random(9);
  const auto key = [](const Item& x) { return x.key; };
  for (const int count : {0, 1, 4001, 8003, 100000})
    for (const int spread : {0, 12, 40})
      for (const int threads : {1, 2, 3, 16}) {
        // Keys of their own: most of them near one another, a hundredth far from those.
        std::vector<Item> mine = items(count, 0, random);
        for (int i = 0; i < count; ++i) {
          const bool is_far = i % 100 == 0;
          mine[std::size_t(i)].key = std::uint64_t(i) << (is_far ? spread : 0) | std::uint64_t(is_far) << 63;
        }
        std::shuffle(mine.begin(), mine.end(), random);
        std::vector<Item> theirs = mine, scratch(mine.size());
        in_arena(threads, [&] { CHECK(parallel_radix_sort(mine.data(), scratch.data(), mine.size(), key)); });
        std::stable_sort(theirs.begin(), theirs.end(),
                         [](const Item& x, const Item& y) { return x.key < y.key; });
        CAPTURE(spread, count, threads);
        CHECK((mine == theirs));
      }
}

TEST_CASE("sorting by digits with more threads can be stopped", "[unit]") {
  scenes::Random random(10);
  const auto key = [](const Item& x) { return x.key; };
  const std::vector<Item> all = items(100000, ~std::uint64_t(0), random);
  tests::Asks asks;
  const auto sort = [&](tests::Asks& asked) {
    std::vector<Item> mine = all, scratch(all.size());
    bool done = false;
    in_arena(
        4, [&] { done = parallel_radix_sort(mine.data(), scratch.data(), mine.size(), key, asked.stop()); });
    return done;
  };
  REQUIRE(sort(asks));
  CHECK(asks.count > 40);
  for (std::int64_t n = 0; n < asks.count; ++n) {
    tests::Asks some(n);
    CHECK_FALSE(sort(some));
  }
}
