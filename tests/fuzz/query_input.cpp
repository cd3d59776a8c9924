#include "tests/fuzz/query_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/narrowphase/exact/exact_query.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/quick.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/oracle/within.hpp"
#include "tests/scenes/families.hpp"

namespace onset::fuzz {
namespace {

using scenes::Query;
using scenes::Random;

constexpr double kLargest = 0x1p1020;  // beyond it a coordinate is out of range

std::array<double*, 24> coordinates(Query& query) {
  std::array<double*, 24> all{};
  std::size_t i = 0;
  for (auto* points : {&query.t0, &query.t1})
    for (Point& p : *points)
      for (double& x : p) all[i++] = &x;
  return all;
}

double size_of(const Query& query) {
  double size = 0;
  for (const auto* points : {&query.t0, &query.t1})
    for (const Point& p : *points)
      for (double x : p) size = std::isnan(x) ? INFINITY : std::max(size, std::fabs(x));
  return size;
}

// Finite and in range.
bool is_usable(const Query& query) { return size_of(query) <= kLargest; }

// Integer arithmetic needs no size; the rational oracle rounds distances to doubles, and takes seconds for a
// separation of far below a query's size.
bool of_common_size(const Query& query, double d) {
  const double size = size_of(query);
  return size < 0x1p500 && d < 0x1p500 && (d == 0 || d > 0x1p-100 * size);
}

// What is known about the first contact: that there is none, or an interval that holds it, of adjacent
// doubles where `exact`.
struct Truth {
  bool touches = false, exact = false;
  DoubleBracket time;
};

// Doubles where they are certain, then the integers, and their exact time only where it is asked for.
Truth truth_of(const Query& query, bool exact) {
  Truth truth;
  if (oracle::surely_apart(query)) return truth;
  const ExactPair pair = scenes::exact_pair(query);
  const ExactAnswer answer = exact_answer(pair, Effort::complete);
  if (answer.answer == Answer::no) return truth;
  truth.touches = true, truth.exact = exact, truth.time = answer.time;
  if (exact) truth.time = exact_first_contact(pair).value();
  return truth;
}

Broken against(const Truth& truth, const QueryInput& input, const QueryResult& r) {
  const Options& o = input.options;
  if (r.outcome == PairOutcome::free ? r.toi != INFINITY : !(r.toi >= 0 && r.toi <= 1)) return Broken::late;
  if (truth.touches && !r.collides()) return Broken::missed;
  if (truth.touches && !(r.toi <= truth.time.lo)) return Broken::late;
  if (o.min_separation > 0 || !r.collides()) return Broken::none;
  const bool certain = r.certainty != Certainty::within_tolerance;
  if (!truth.touches) return certain || o.exactness == Exactness::exact ? Broken::false_hit : Broken::none;
  if (!(r.toi_hi >= truth.time.hi)) return Broken::toi_hi;
  const bool off = truth.exact && (r.toi != truth.time.lo || r.toi_hi != truth.time.hi);
  return off && o.exactness == Exactness::exact ? Broken::not_exact : Broken::none;
}

// Whether the interval of exact_answer() cannot tell: then the doubles around the contact are asked for.
bool leaves_open(const Truth& truth, const QueryInput& input, const QueryResult& r) {
  if (!truth.touches || truth.exact || !r.collides()) return false;
  return input.options.exactness == Exactness::exact || !(r.toi <= truth.time.lo) ||
         !(r.toi_hi >= truth.time.hi);
}

// A distance in doubles, about: of the points in units of `size`.
double about_distance(const Query& query, double size) {
  std::array<oracle::Vector<double>, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t a = 0; a < 3; ++a) x[i][a] = query.t0[i][a] / size;
  const auto r = oracle::relative<double>(query.kind, x);
  const auto inside = oracle::shortest_difference(r);
  double least = oracle::dot(inside, inside);
  for (const auto& segment : oracle::boundary(r)) {
    const auto d = oracle::nearest_to_origin(segment);
    least = std::min(least, oracle::dot(d, d));
  }
  return std::sqrt(least);
}

// A start that is apart by far more than rounding can hide; 2^-30 of the size is a thousand times what it
// does hide where magnitudes differ by 1e60 within a pair.
bool is_silent_zero(const QueryInput& input, const QueryResult& r) {
  const Options& o = input.options;
  const double d = o.min_separation, size = size_of(input.query);
  if (r.toi > 0 || !of_common_size(input.query, d) || size < 0x1p-1000) return false;
  if (about_distance(input.query, size) < d / size + 0x1p-34) return false;
  const double much = 0x1p-30 * (oracle::extent(input.query) + d);
  return oracle::compare_distance(input.query, 0, d + much, o.norm) > 0;
}

Broken check(const QueryInput& input, QueryResult& r) {
  r = scenes::ccd(input.query, input.options);
  const bool bad = r.outcome == PairOutcome::non_finite || r.outcome == PairOutcome::out_of_range;
  if (!is_usable(input.query)) return bad && r.toi == 0 ? Broken::none : Broken::outcome;
  if (bad) return Broken::outcome;
  if (r.checks > input.options.max_checks) return Broken::report;
  Truth truth = truth_of(input.query, false);
  if (leaves_open(truth, input, r)) truth = truth_of(input.query, true);
  const Broken broken = against(truth, input, r);
  if (broken != Broken::none) return broken;
  return is_silent_zero(input, r) ? Broken::silent_zero : Broken::none;
}

void describe_length(Bytes& bytes, double& length, double low, double high) {
  bytes.real(length);
  if (bytes.reads() && !(length >= low && length <= high))
    length = std::isfinite(length) ? std::min(std::max(std::fabs(length), low), high) : low;
}

}  // namespace

const char* name(Broken broken) {
  const char* names[] = {"none",      "missed",      "late",    "toi_hi early", "false",
                         "not exact", "silent zero", "outcome", "report",       "oracle"};
  return names[int(broken)];
}

void describe(Bytes& bytes, QueryInput& input) {
  Options& o = input.options;
  bytes.whole(input.query.kind, 0, 1);
  describe_length(bytes, o.relative_tolerance, 0x1p-1074, 0x1p1000);
  bool has_tolerance = o.tolerance.has_value(), separated = o.min_separation > 0;
  bytes.flag(has_tolerance);
  if (has_tolerance) {
    double tolerance = o.tolerance.value_or(1);
    describe_length(bytes, tolerance, 0x1p-1074, 0x1p1000);
    o.tolerance = tolerance;
  }
  bytes.flag(separated);
  if (separated) describe_length(bytes, o.min_separation, 0, kLargest);
  bytes.whole(o.norm, 0, 1);
  bytes.whole(o.max_checks, 1, 10000);
  bytes.whole(o.exactness, 0, 2);
  bytes.flag(o.touching_may_pass_through);
  bytes.whole(o.narrow_phase, 0, 1);
  if (o.narrow_phase == NarrowPhaseMethod::inclusion)
    o.max_checks = std::min<std::int64_t>(o.max_checks, 1000);
  bool scalar = o.instruction_set == InstructionSet::scalar;
  bytes.flag(scalar);
  o.instruction_set = scalar ? InstructionSet::scalar : InstructionSet::automatic;
  // One byte a coordinate, in some unit, for ties; or all bits of each.
  bool small = false;
  bytes.flag(small);
  int exponent = 0;
  if (small) bytes.whole(exponent, -1074, 1019);
  for (double* x : coordinates(input.query)) {
    int steps = 0;
    if (small)
      bytes.whole(steps, -16, 16), *x = std::ldexp(double(steps), exponent);
    else
      bytes.real(*x);
  }
}

std::string to_text(const QueryInput& input) {
  const Options& o = input.options;
  char line[300];
  std::snprintf(line, sizeof line,
                " relative_tolerance %a tolerance %a min_separation %a norm %d max_checks %lld exactness %d "
                "pass %d inclusion %d scalar %d",
                o.relative_tolerance, o.tolerance.value_or(-1), o.min_separation, int(o.norm),
                static_cast<long long>(o.max_checks), int(o.exactness), int(o.touching_may_pass_through),
                int(o.narrow_phase), int(o.instruction_set == InstructionSet::scalar));
  return scenes::to_text(input.query) + line;
}

Broken check_quickly(const QueryInput& input) {
  QueryResult r;
  return check(input, r);
}

Broken check_fully(const QueryInput& input, std::string& why) {
  QueryResult r;
  const Broken broken = check(input, r);
  if (broken != Broken::none || !is_usable(input.query)) return broken;
  const oracle::Truth exact = oracle::exact_ccd(input.query);
  const auto truth = exact_first_contact(scenes::exact_pair(input.query));
  if (exact.collides != truth.has_value()) return Broken::oracle;
  if (truth && (exact.toi_lo != truth->lo || exact.toi_hi != truth->hi)) return Broken::oracle;
  const double d = input.options.min_separation;
  if (!of_common_size(input.query, d)) return Broken::none;
  if (d > 0) {
    const oracle::Truth within = oracle::exact_within(input.query, d, input.options.norm);
    if (within.collides && !r.collides()) return Broken::missed;
    if (within.collides && !(r.toi <= within.toi_lo)) return Broken::late;
  }
  why = oracle::wrong_report(input.query, input.options, r);
  if (!why.empty()) why += ", " + oracle::to_text(input.options, r);
  return why.empty() ? Broken::none : Broken::report;
}

void change(Query& query, Random& random) {
  const auto all = coordinates(query);
  for (int times = scenes::integer(random, 1, 3); times > 0; --times) {
    const auto any = [&]() -> double& { return *all[std::size_t(scenes::integer(random, 0, 23))]; };
    const std::size_t p = std::size_t(scenes::integer(random, 0, 3)),
                      q = std::size_t(scenes::integer(random, 0, 3));
    switch (scenes::integer(random, 0, 9)) {
      case 0:
        any() = any();
        break;
      case 1: {
        double& x = any();
        for (int i = scenes::integer(random, 1, 4); i > 0; --i)
          x = std::nextafter(x, scenes::coin(random) ? 1e300 : -1e300);
        break;
      }
      case 2:
        any() = 0;
        break;
      case 3:
        any() *= -1;
        break;
      case 4: {
        // The integers of magnitudes far apart are long, so few get any bits.
        std::uint64_t bits = random();
        double& x = any();
        if (scenes::integer(random, 0, 31) == 0)
          std::memcpy(&x, &bits, sizeof bits);
        else
          x = std::ldexp(x * (1 + std::int64_t(bits) * 0x1p-64), scenes::integer(random, -6, 6));
        break;
      }
      case 5:
        query.t1[p] = query.t0[p];
        break;
      case 6:
        query.t0[p] = query.t0[q], query.t1[p] = scenes::coin(random) ? query.t1[q] : query.t1[p];
        break;
      case 7:
        query.t1[p] = query.t1[q];
        break;
      case 8: {
        const double factor = std::ldexp(1.0, scenes::integer(random, -900, 900));
        query = scaled(query, factor);
        break;
      }
      default: {
        const int axis = scenes::integer(random, 0, 2);
        for (std::size_t i = 0; i < 4; ++i)
          query.t0[i][std::size_t(axis)] = query.t1[i][std::size_t(axis)] = any();
        break;
      }
    }
  }
}

Options random_query_options(const Query& query, Random& random) {
  Options o;
  const double size = size_of(query);
  if (scenes::coin(random))
    o.relative_tolerance = std::ldexp(1.0, -scenes::integer(random, 4, scenes::coin(random) ? 60 : 1000));
  if (scenes::integer(random, 0, 7) == 0 && size < kLargest)
    o.tolerance = std::max(0x1p-1074, std::ldexp(size, -scenes::integer(random, 4, 60)));
  if (scenes::integer(random, 0, 7) == 0 && size < 0x1p500)
    o.min_separation = std::ldexp(size, -scenes::integer(random, 1, 60));
  o.norm = scenes::integer(random, 0, 3) ? Norm::euclidean : Norm::maximum;
  const std::int64_t checks[] = {1, 2, 5, 20, 100, 1000, 10000};
  o.max_checks = checks[scenes::integer(random, 0, 6)];
  o.exactness = Exactness(scenes::integer(random, 0, 2));
  o.touching_may_pass_through = scenes::integer(random, 0, 7) == 0;
  o.instruction_set = scenes::coin(random) ? InstructionSet::scalar : InstructionSet::automatic;
  if (scenes::integer(random, 0, 63) == 0) {
    o.narrow_phase = NarrowPhaseMethod::inclusion;
    o.max_checks = std::min<std::int64_t>(o.max_checks, 100);
  }
  return o;
}

}  // namespace onset::fuzz
