// What each certificate vouches for holds exactly: the direction it uses separates the pair by the distance
// demanded, on the whole interval. States are not only those that advancement reaches.
#include <cmath>

#include "narrowphase/interval_certificate.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/exact/exact_pair.hpp"
#include "tests/narrowphase/kernel/kernel_batch.hpp"
#include "tests/narrowphase/kernel/kernel_values.hpp"
#include "tests/narrowphase/query_corners.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/oracle/distance.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

// The closest point's direction at t, roughly, and the distance.
double closest_direction(const Query& query, double t, double (&w)[3]) {
  std::array<oracle::Vector<double>, 4> x;
  for (int i = 0; i < 4; ++i) x[i] = scenes::lerp(query.t0[i], query.t1[i], t);
  auto f = oracle::shortest_difference(oracle::relative(query.kind, x));
  const double n = std::hypot(f[0], f[1], f[2]), sign = query.kind == PairKind::vertex_face ? 1 : -1;
  for (int a = 0; a < 3; ++a) w[a] = n > 0 ? sign * f[a] / n : 0;
  const double length = std::hypot(w[0], w[1], w[2]);
  for (double& x : w) x = length > 1 ? x / length : x;
  return n;
}

// Advancement at a random time, demanding nearly as much as there is.
CertificateState some_state(const Query& query, double unit, Random& random) {
  CertificateState s{};
  s.t = scenes::integer(random, 0, 3) ? scenes::unit(random) : 0;
  s.t_prev = s.t * scenes::unit(random);
  const double distance = closest_direction(query, s.t, s.w) / unit;
  closest_direction(query, s.t_prev, s.w_prev);
  if (scenes::coin(random)) s.separation = distance * scenes::unit(random);
  const double left = std::max(0.0, distance - s.separation);
  s.delta = left * (scenes::coin(random) ? 2 * (1 - scenes::power_of_ten(random, -15, -0.2))
                                         : scenes::power_of_ten(random, -12, 0));
  return s;
}

// Whether the exact distance exceeds `wanted` (times unit) all along [from, to], as far as samples tell; the
// ends are where a certificate is tightest.
bool apart(const Query& query, double from, double to, double wanted, Norm norm) {
  for (double part : {1.0, 0.0, 0.5, 0.9, 0.999})
    if (oracle::compare_distance(query, from + part * (std::min(to, 1.0) - from), wanted, norm) <= 0)
      return false;
  return true;
}

struct Tally {
  int fixed = 0, moving = 0, normal = 0, partial = 0;
};

void check(const std::string& source, const Query& query, Random& random,
           decltype(&certificates_plain) certificates, Tally& tally) {
  const bool ee = query.kind == PairKind::edge_edge;
  KernelBatch batch(query.kind);
  batch.add(query, 0);
  const Norm norm = scenes::integer(random, 0, 2) ? Norm::euclidean : Norm::maximum;
  const KernelPairs pairs = batch.pairs(1, norm == Norm::maximum);
  const double unit = certificates(ee, pairs, 0, {}).unit;
  const CertificateState state = some_state(query, unit, random);
  const Certificates r = certificates(ee, pairs, 0, state);
  const struct {
    const char* name;
    double until;
    int& count;
  } all[] = {{"fixed", r.fixed, tally.fixed},
             {"moving", r.moving, tally.moving},
             {"normal", r.normal, tally.normal}};
  for (const auto& c : all) {
    if (!(c.until > state.t)) continue;
    ++c.count;
    tally.partial += c.until < 1;
    if (!apart(query, state.t, c.until, r.wanted_distance * unit, norm))
      FAIL_CHECK(source << ": " << c.name << " from " << state.t << " until " << c.until << " norm "
                        << int(norm) << "\n  " << to_text(query));
  }
}

bool usable(const Query& query) {
  const double size = extent(query);
  return size > 0x1p-900 && size < 0x1p900;
}

void check_all(decltype(&certificates_plain) certificates) {
  Tally tally;
  for_each_query(all_sources(), fuzz(12), 91,
                 [&](const std::string& source, const Query& query, Random& random) {
                   if (usable(query)) check(source, query, random, certificates, tally);
                 });
  CAPTURE(tally.fixed, tally.moving, tally.normal, tally.partial);
  CHECK(tally.fixed > fuzz(300));
  CHECK(tally.moving > fuzz(300));
  CHECK(tally.normal > fuzz(100));
  CHECK(tally.partial > fuzz(300));
}

}  // namespace

TEST_CASE("every certified interval is free", "[property][oracle]") { check_all(certificates_plain); }

#ifdef ONSET_HAVE_FMA
TEST_CASE("every interval certified by contracted code is free", "[property][oracle]") {
  if (__builtin_cpu_supports("fma")) check_all(certificates_contracted);
}
#endif

TEST_CASE("every interval certified along an edge is free", "[property][oracle]") {
  int certified = 0, partial = 0;
  for_each_query(
      all_sources(), fuzz(60), 92, [&](const std::string& source, const Query& query, Random& random) {
        if (!usable(query)) return;
        const Corners corners = corners_of(query);
        const Norm norm = scenes::coin(random) ? Norm::euclidean : Norm::maximum;
        const double t = scenes::unit(random);
        const double wanted = rough_distance(query, t, norm) * (1 - scenes::power_of_ten(random, -15, 0));
        const double until = certify_interval(corners, t, wanted / corners.unit, norm == Norm::maximum);
        if (!(until > t)) return;
        ++certified, partial += until < 1;
        if (!apart(query, t, until, wanted, norm))
          FAIL_CHECK(source << " from " << t << " to " << until << "\n  " << to_text(query));
      });
  CAPTURE(certified, partial);
  CHECK(certified > fuzz(300));
  CHECK(partial > fuzz(100));
}
