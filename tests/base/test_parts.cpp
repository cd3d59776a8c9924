// What tasks collect is put in order whatever there is of it, and no longer than it is wanted.
#include <algorithm>
#include <cmath>

#include "base/parts.hpp"
#include "tests/asks.hpp"
#include "tests/catch.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using tests::Asks;

namespace {

struct Item {
  std::uint64_t key;
  double payload[3];
  bool operator==(const Item& o) const { return key == o.key && std::equal(payload, payload + 3, o.payload); }
};

std::uint64_t key_of(const Item& item) { return item.key; }

Item item(std::uint64_t key) { return {key, {double(key % 1000), double(key >> 33), -1}}; }

// Ascending keys, no two alike: spread, all with one first id but a few, or with few first ids.
std::vector<Item> ordered(std::size_t count, int kind) {
  std::vector<Item> items;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t spread = std::uint64_t(i) * 0x10001 << 8;
    const std::uint64_t hub = i + 3 < count ? i : (std::uint64_t(i) << 40);
    const std::uint64_t ids = std::uint64_t(i / 1000) << 32 | (i % 1000);
    items.push_back(item(kind == 0 ? spread : kind == 1 ? hub : ids));
  }
  return items;
}

// Adds the items in parts of random sizes, in random order, from several threads.
void fill(Parts<Item>& parts, std::vector<Item> items, scenes::Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random() % i]);
  std::vector<std::size_t> ends;
  for (std::size_t at = 0; at < items.size();) {
    const double size = std::exp(scenes::uniform(random, 0, 10));
    ends.push_back(at = std::min(items.size(), at + std::size_t(size)));
  }
  parallel_ranges(ends.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::vector<Item> part(items.begin() + std::ptrdiff_t(i == 0 ? 0 : ends[i - 1]),
                             items.begin() + std::ptrdiff_t(ends[i]));
      parts.add(part);
      if (!part.empty()) throw std::logic_error("what was handed over is still there");
    }
  });
}

}  // namespace

TEST_CASE("parts are put in the order of their keys, after what is there already", "[property]") {
  scenes::Random random(11);
  for (const int kind : {0, 1, 2})
    for (const std::size_t count : {std::size_t(0), std::size_t(1), std::size_t(700), Parts<Item>::kPart,
                                    Parts<Item>::kPart + 1, std::size_t(200000)}) {
      CAPTURE(kind, count);
      std::vector<Item> expected{item(~std::uint64_t(0))}, found = expected;
      const std::vector<Item> items = ordered(count, kind);
      expected.insert(expected.end(), items.begin(), items.end());
      Parts<Item> parts;
      fill(parts, items, random);
      CHECK(parts.size() == count);
      CHECK(parts.sort_into(found, key_of, {}));
      CHECK((found == expected));
      CHECK(parts.size() == 0);
    }
}

TEST_CASE("parts whose keys are all alike are all there after sorting", "[unit]") {
  const std::size_t count = 2 * Parts<Item>::kPart + 7;
  std::vector<Item> items(count, item(5)), found;
  for (std::size_t i = 0; i < count; ++i) items[i].payload[2] = double(i);
  Parts<Item> parts;
  for (std::size_t i = 0; i < count; i += 1000) {
    std::vector<Item> part(items.begin() + std::ptrdiff_t(i),
                           items.begin() + std::ptrdiff_t(std::min(count, i + 1000)));
    parts.add(part);
  }
  REQUIRE(parts.sort_into(found, key_of, {}));
  std::sort(found.begin(), found.end(),
            [](const Item& p, const Item& q) { return p.payload[2] < q.payload[2]; });
  CHECK((found == items));
}

TEST_CASE("sorting parts can be stopped wherever it asks, and asks all the time", "[property]") {
  scenes::Random random(12);
  for (const int kind : {0, 1, 2}) {
    const std::vector<Item> items = ordered(300000, kind);
    Asks all;
    std::vector<Item> found;
    Parts<Item> parts;
    fill(parts, items, random);
    REQUIRE(parts.sort_into(found, key_of, all.stop()));
    // Each of its five rounds over the items asks once a part at least.
    CHECK(all.count >= 5 * std::int64_t(items.size() / (2 * Parts<Item>::kPart)));
    for (std::int64_t n = 0; n < all.count; n += 1 + n / 4) {
      CAPTURE(kind, n);
      Asks some(n);
      std::vector<Item> kept{item(7)};
      fill(parts, items, random);
      CHECK_FALSE(parts.sort_into(kept, key_of, some.stop()));
      CHECK((kept == std::vector<Item>{item(7)}));
      CHECK(parts.size() == 0);
    }
  }
}

TEST_CASE("some of the parts are copied, no more than asked for", "[unit]") {
  scenes::Random random(13);
  const std::vector<Item> items = ordered(100000, 2);
  for (const std::size_t most : {std::size_t(0), std::size_t(1), std::size_t(30000), std::size_t(200000)}) {
    Parts<Item> parts, some;
    fill(parts, items, random);
    parts.copy_some(some, most);
    CHECK(some.size() == std::min(most, items.size()));
    CHECK(parts.size() == items.size());
    std::vector<Item> found;
    CHECK(some.sort_into(found, key_of, {}));
    CHECK(std::includes(items.begin(), items.end(), found.begin(), found.end(),
                        [](const Item& p, const Item& q) { return p.key < q.key; }));
  }
}
