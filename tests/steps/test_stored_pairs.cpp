// One pair pushed on from stored position to stored position, by each of the calls, far from the origin too:
// it never touches, never passes, and is never stopped while there is room.
#include "tests/catch.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/quick.hpp"
#include "tests/oracle/stored.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"
#include "tests/src/support/one_pair.hpp"
#include "tests/steps/support/calls.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

constexpr double kOffsets[] = {0, 1, 1e3, 1e5, 1e7, 1e9};
constexpr int kPushes = 60;
enum class Aim { press, slide, part, turn, any };

// The first body a small way above the second, within its reach, both about unit size; somewhere at `offset`.
std::array<Point, 4> above(PairKind kind, double offset, Random& random) {
  const Point a{1, scenes::uniform(random, -0.5, 0.5), 0}, b{scenes::uniform(random, -0.5, 0.5), 1, 0};
  const double u = scenes::uniform(random, 0.1, 0.4), v = scenes::uniform(random, 0.1, 0.4);
  Point q = scenes::plus(scenes::times(u, a), scenes::times(v, b));
  q[2] = scenes::power_of_ten(random, -6, 0);
  const scenes::Matrix turn = scenes::coin(random) ? scenes::signed_permutation(random)
                                                   : scenes::rotation(random, scenes::uniform(random, 0, 3));
  const scenes::Relative r{scenes::product(turn, q), scenes::product(turn, a), scenes::product(turn, b)};
  const double size = offset > 1e6 ? 1 : scenes::power_of_ten(random, -3, 0);
  std::array<Point, 4> x = placed(kind, r, {});
  const Point where = scenes::point(random, offset);
  for (Point& p : x) p = scenes::plus(scenes::times(size, p), where);
  return x;
}

// How far one body is from the other, in doubles.
Point way(PairKind kind, const std::array<Point, 4>& x) {
  const int first = scenes::first_body(kind);
  Point from{}, to{};
  for (int i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      (i < first ? from : to)[k] += x[std::size_t(i)][k] / (i < first ? first : 4 - first);
  return scenes::minus(to, from);
}

// The plane's normal on the side of the first body, of unit length but for rounding; in doubles.
Point side(PairKind kind, const std::array<Point, 4>& x) {
  const bool face = kind == PairKind::vertex_face;
  const Point a = face ? scenes::minus(x[2], x[1]) : scenes::minus(x[1], x[0]),
              b = scenes::minus(x[3], face ? x[1] : x[2]);
  Point n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const Point w = way(kind, x);
  const double sign = n[0] * w[0] + n[1] * w[1] + n[2] * w[2] > 0 ? -1 : 1;
  return length > 0 ? scenes::times(sign / length, n) : Point{0, 0, 1};
}

// Where the pair would like to be: through the other, along it, away from it, turned, or anywhere.
Query aimed(PairKind kind, const std::array<Point, 4>& x, Aim aim, Random& random) {
  const double size = std::abs(x[2][0] - x[3][0]) + std::abs(x[2][1] - x[3][1]) + std::abs(x[2][2] - x[3][2]);
  const int how_far = scenes::integer(random, 0, 7);
  const double far = size * (how_far == 0   ? scenes::power_of_ten(random, 0, 12)
                             : how_far == 1 ? scenes::power_of_ten(random, -20, -4)
                                            : scenes::power_of_ten(random, -4, 0.5));
  const double scatter = aim == Aim::any ? far : 0;
  const double along = aim == Aim::press || aim == Aim::part ? 0 : 0.2 * far;
  Point step =
      scenes::plus(scenes::times(aim == Aim::part ? far : -far, side(kind, x)), scenes::point(random, along));
  if (aim == Aim::turn) step = scenes::times(0.1, step);
  const scenes::Matrix turn = scenes::rotation(random, aim == Aim::turn ? scenes::uniform(random, -1, 1) : 0);
  Query query{kind, x, x};
  const Point pivot = x[0];
  for (int i = 0; i < 4; ++i) {
    Point& p = query.t1[std::size_t(i)];
    const bool first = i < scenes::first_body(kind);
    if (first && aim == Aim::turn) p = scenes::plus(pivot, scenes::product(turn, scenes::minus(p, pivot)));
    if (first) p = scenes::plus(p, step);
    if (scatter > 0) p = scenes::plus(p, scenes::point(random, 0.3 * scatter));
  }
  return query;
}

Query with_end(const Query& query, const Eigen::MatrixXd& x_t1) {
  Query q = query;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) q.t1[i][k] = x_t1(Eigen::Index(i), Eigen::Index(k));
  return q;
}

struct Counts {
  long long pushes = 0, through = 0, stuck = 0, within = 0, stopped = 0, bad = 0;
};

Options some_options(double separation, Random& random) {
  Options o;
  o.exactness = Exactness(scenes::integer(random, 0, 2));
  if (scenes::coin(random)) o.relative_tolerance = scenes::power_of_ten(random, -16, -2);
  o.min_separation = separation;
  o.threads = 1;
  return o;
}

// Empty, or what a step did to the pair; the next stored position is put into x.
std::string broken_by(const CallStep& step, const Query& motion, double d, oracle::Rounding how,
                      std::array<Point, 4>& x, Counts& counts) {
  const double s = step.result.step, rounding = step.result.rounding;
  ++counts.pushes;
  if (!(s >= 0 && s <= 1)) return ++counts.bad, "a step outside [0, 1]";
  const bool room = oracle::compare_distance(motion, 0, d + 2 * rounding) > 0;
  counts.stopped += s == 0;
  if (s == 0 && room && !step.blind())
    return ++counts.stuck, "stuck, though its gap is more than twice the rounding";
  if (s == 0) return {};
  x = oracle::stored(how, motion, s);
  const std::string broken = oracle::broken_on_the_way(motion, s, x);
  if (!broken.empty()) return ++counts.through, broken;
  if (d > 0 && room && oracle::compare_distance_at_rest(motion.kind, x, d) <= 0)
    return ++counts.within, "is stored within the separation";
  return {};
}

// One push towards where the pair would like to be. False where a promise is broken.
bool push(const Calls& calls, Call call, const Query& wish, const Options& options, std::array<Point, 4>& x,
          Random& random, Counts& counts) {
  const Eigen::MatrixXd x_t0 = positions(wish.t0), x_t1 = end_of(call, x_t0, positions(wish.t1));
  const CallStep step = calls.ask(call, x_t0, x_t1, options, scenes::power_of_ten(random, -3, 1));
  const Query motion = with_end(wish, x_t1);
  const oracle::Rounding how = oracle::kRoundings[scenes::integer(random, 0, 2)];
  const std::string broken = broken_by(step, motion, options.min_separation, how, x, counts);
  if (broken.empty()) return true;
  FAIL_CHECK(name(call) << ": " << broken << "\n  " << to_string(step.result.outcome) << ", step "
                        << step.result.step << ", rounding " << step.result.rounding << ", separation "
                        << options.min_separation << ", exactness " << int(options.exactness)
                        << ", tolerance " << options.relative_tolerance << "\n  " << to_text(motion));
  return false;
}

void push_on(PairKind kind, Call call, Aim aim, double offset, double separation, Random& random,
             Counts& counts) {
  const Elements elements = elements_of(kind);
  std::array<Point, 4> x = above(kind, offset, random);
  const Calls calls({positions(x), positions(x), elements.edges, elements.faces});
  const Options options = some_options(separation, random);
  const int began = oracle::orientation(kind, x);
  for (int i = 0; i < kPushes; ++i)
    if (!push(calls, call, aimed(kind, x, aim, random), options, x, random, counts)) return;
  if (aim == Aim::press) CHECK(oracle::orientation(kind, x) == began);
}

Counts push_all(int pairs, std::uint64_t seed, bool separated) {
  Random random(oracle::fuzz_seed() * 1000 + seed);
  Counts counts;
  for (int i = 0; i < pairs; ++i) {
    const PairKind kind = scenes::coin(random) ? PairKind::vertex_face : PairKind::edge_edge;
    const Aim aim = Aim(scenes::integer(random, 0, 4));
    const double offset = kOffsets[scenes::integer(random, 0, 5)];
    const double separation = separated ? scenes::power_of_ten(random, -9, -7) : 0;
    for (Call call : kCalls) push_on(kind, call, aim, offset, separation, random, counts);
  }
  std::printf(
      "%d pairs pushed by every call: %lld pushes, %lld through, %lld within, %lld stuck, %lld stopped\n",
      pairs, counts.pushes, counts.through, counts.within, counts.stuck, counts.stopped);
  return counts;
}

}  // namespace

TEST_CASE("a pair pushed on by any call is never stored through, nor stuck while there is room",
          "[property][oracle]") {
  const Counts c = push_all(oracle::fuzz(40), 11, false);
  CHECK(c.through + c.stuck + c.bad == 0);
  CHECK(c.stopped > 0);
}

TEST_CASE("a pair pushed on beyond a separation is never stored within it", "[property][oracle]") {
  const Counts c = push_all(oracle::fuzz(20), 12, true);
  CHECK(c.through + c.within + c.stuck + c.bad == 0);
}

TEST_CASE("a pair that is out of room moves on where the motion clears it", "[property][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 13);
  int out_of_room = 0;
  for (int i = 0; i < oracle::fuzz(40); ++i) {
    const PairKind kind = scenes::coin(random) ? PairKind::vertex_face : PairKind::edge_edge;
    const Elements elements = elements_of(kind);
    std::array<Point, 4> x = above(kind, kOffsets[scenes::integer(random, 0, 5)], random);
    const Calls calls({positions(x), positions(x), elements.edges, elements.faces});
    const Options options = some_options(0, random);
    Counts counts;
    bool whole = true;
    for (int k = 0; k < kPushes && whole && counts.stopped == 0; ++k)
      whole = push(calls, Call::whole, aimed(kind, x, Aim::press, random), options, x, random, counts);
    if (!whole || counts.stopped == 0) continue;
    ++out_of_room;
    Query parting{kind, x, x};
    const double far = 0.25 * std::abs(way(kind, x)[0]) + 0.01;
    for (int k = 0; k < scenes::first_body(kind); ++k)
      parting.t1[std::size_t(k)] = scenes::plus(x[std::size_t(k)], scenes::times(far, side(kind, x)));
    if (oracle::compare_distance(parting, 0, 0) == 0) continue;
    for (Call call : kCalls) {
      const Eigen::MatrixXd x_t0 = positions(x), x_t1 = end_of(call, x_t0, positions(parting.t1));
      const CallStep step = calls.ask(call, x_t0, x_t1, options, 0.01);
      INFO(name(call) << ", " << to_string(step.result.outcome) << ", step " << step.result.step << ", "
                      << to_text(parting));
      CHECK(step.result.step > 0);
      std::array<Point, 4> next = x;
      CHECK(broken_by(step, with_end(parting, x_t1), 0, oracle::Rounding::product, next, counts) == "");
    }
  }
  CHECK(4 * out_of_room > oracle::fuzz(40));
}

TEST_CASE("a line search that is asked for less gives no more, and nothing less safe", "[property][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 14);
  for (int i = 0; i < oracle::fuzz(150); ++i) {
    const PairKind kind = scenes::coin(random) ? PairKind::vertex_face : PairKind::edge_edge;
    const std::array<Point, 4> x = above(kind, kOffsets[scenes::integer(random, 0, 5)], random);
    const Query wish = aimed(kind, x, Aim(scenes::integer(random, 0, 4)), random);
    const Eigen::MatrixXd x_t0 = positions(wish.t0), dx = positions(wish.t1) - x_t0;
    const Query motion = with_end(wish, x_t0 + dx);
    const Options o = some_options(0, random);
    const LineSearch search(mesh_of(kind), x_t0, dx, with_share(o, scenes::uniform(random, 0, 0.9)));
    for (double upper : {1.0, 0.0, scenes::unit(random), scenes::power_of_ten(random, -12, 0), 1.0}) {
      const LineSearchStep r = search.largest_step(upper);
      const double s = r.step;
      INFO(to_text(motion) << ", upper " << upper << " -> " << s << " " << to_string(r.outcome));
      CHECK((s >= 0 && s <= upper));
      CHECK((r.outcome == Outcome::free) == (s == upper && !r.limiting));
      for (oracle::Rounding how : oracle::kRoundings)
        if (s > 0)
          CHECK(std::string(oracle::broken_on_the_way(motion, s, oracle::stored(how, motion, s))) == "");
      if (s == 0 && upper > 0) CHECK(oracle::compare_distance(motion, 0, 2 * r.rounding) <= 0);
    }
  }
}
