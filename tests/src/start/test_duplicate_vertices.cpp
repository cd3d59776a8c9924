// Vertices at one place, whatever their coordinates, also where these were chosen to make the search slow.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/counted_clock.hpp"
#include "tests/scenes/random.hpp"

using namespace onset;
using scenes::Random;

namespace {

// Inverts h ^ (h >> shift).
std::uint64_t unshifted(std::uint64_t h, int shift) {
  std::uint64_t r = h;
  for (int known = shift; known < 64; known += shift) r = h ^ (r >> shift);
  return r;
}
std::uint64_t inverse(std::uint64_t odd) {
  std::uint64_t x = odd;  // right in 3 bits, and in twice as many each time
  for (int bits = 3; bits < 64; bits *= 2) x *= 2 - odd * x;
  return x;
}

// The mixing of src/start/duplicate_vertices.cpp, and back.
constexpr std::uint64_t kAdded = 0x9e3779b97f4a7c15u, kFirst = 0xbf58476d1ce4e5b9u,
                        kSecond = 0x94d049bb133111ebu;
std::uint64_t mixed(std::uint64_t h, double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  h = (h ^ bits) + kAdded;
  h = (h ^ (h >> 30)) * kFirst;
  h = (h ^ (h >> 27)) * kSecond;
  return h ^ (h >> 31);
}
double unmixed(std::uint64_t wanted, std::uint64_t h) {
  wanted = unshifted(wanted, 31) * inverse(kSecond);
  wanted = unshifted(wanted, 27) * inverse(kFirst);
  const std::uint64_t bits = (unshifted(wanted, 30) - kAdded) ^ h;
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

Eigen::MatrixXd ordinary(int count) {
  Random random(93);
  Eigen::MatrixXd x(count, 3);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = scenes::uniform(random, -1, 1);
  return x;
}

// `count` places that the search puts under one number of 33 bits.
Eigen::MatrixXd crafted(int count) {
  Eigen::MatrixXd x = ordinary(count);
  std::uint64_t i = 0;
  for (Eigen::Index v = 0; v < count; ++v) {
    const std::uint64_t before = mixed(mixed(0, x(v, 0)), x(v, 1));
    do x(v, 2) = unmixed(std::uint64_t(0x155555555) << 31 | i++, before);
    while (!(std::fabs(x(v, 2)) < 1e300 && std::fabs(x(v, 2)) > 1e-300));
  }
  return x;
}

double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Of the fastest of a few runs.
double seconds_of(const Eigen::MatrixXd& x) {
  double least = INFINITY;
  for (int i = 0; i < 3; ++i) {
    const double before = cpu_seconds();
    CHECK(duplicate_vertices(x).empty());
    least = std::min(least, cpu_seconds() - before);
  }
  return least;
}

std::vector<std::array<int, 2>> equal_rows(const Eigen::MatrixXd& x) {
  std::vector<std::array<int, 2>> pairs;
  for (int v = 0; v < x.rows(); ++v)
    for (int w = v + 1; w < x.rows(); ++w)
      if (x.row(v) == x.row(w)) pairs.push_back({v, w});
  return pairs;
}

}  // namespace

TEST_CASE("vertices at one place are found by their coordinates", "[property]") {
  Random random(92);
  for (int round = 0; round < 30; ++round) {
    const int size = 1 + round % 3;
    Eigen::MatrixXd x(40, 3);
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x.data()[i] = scenes::integer(random, -size, size) * (scenes::coin(random) ? 1.0 : -1.0) * 0x1p-1074;
    std::vector<std::array<int, 2>> expected;
    for (int v = 0; v < 40; ++v)
      for (int w = v + 1; w < 40; ++w)
        if (x.row(v) == x.row(w)) expected.push_back({v, w});
    CHECK(duplicate_vertices(x) == expected);
  }
  Eigen::MatrixXd bad = Eigen::MatrixXd::Zero(4, 3);
  bad(2, 1) = NAN;
  CHECK_THROWS_WITH(duplicate_vertices(bad), Catch::Contains("row 2"));
  CHECK(duplicate_vertices(Eigen::MatrixXd(0, 3)).empty());
}

TEST_CASE("vertices at one place are found among places that were made to be taken for one", "[property]") {
  Random random(94);
  for (int places = 1; places < 40; ++places) {
    const Eigen::MatrixXd at = crafted(places);
    Eigen::MatrixXd x(90, 3);
    for (int v = 0; v < 90; ++v) {
      x.row(v) = at.row(scenes::integer(random, 0, places - 1));
      if (v % 3 == 0) x(v, 0) = scenes::integer(random, 0, 1) * -0.0;
    }
    CHECK(duplicate_vertices(x) == equal_rows(x));
  }
}

TEST_CASE("places that were made to be taken for one cost as ordinary ones do, up to a factor",
          "[property]") {
  constexpr int kCount = 60000;
  const Eigen::MatrixXd x = crafted(kCount), y = ordinary(kCount);
  const double slow = seconds_of(x), fast = seconds_of(y);
  CAPTURE(slow, fast);
  CHECK(slow <
        40 * fast);  // six times as many passes; a search among all for each costs some 280 times as much

  const Mesh mesh(kCount, Eigen::MatrixXi(0, 3));
  const tests::CountedClock clock;
  const auto looks = [&](const Eigen::MatrixXd& at, double limit, Outcome expected) {
    Options o;
    o.time_limit = limit;
    const std::int64_t before = clock.looks();
    const StartReport report = check(mesh, at, o);
    CHECK(report.outcome == expected);
    return clock.looks() - before;
  };
  // The time is looked at while they are told apart.
  const std::int64_t of_ordinary = looks(y, 1e12, Outcome::free), of_crafted = looks(x, 1e12, Outcome::free);
  CAPTURE(of_ordinary, of_crafted);
  CHECK(of_crafted > 2 * of_ordinary);
  looks(x, double(of_crafted) / 2, Outcome::out_of_time);
}
