#include "mpi/results.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "scene/pair_source.hpp"
#include "src/shared/checked_options.hpp"

namespace onset::mpi {
namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t x) {
  hash = (hash ^ x) * 0x9e3779b97f4a7c15u;
  return hash ^ hash >> 29;
}
std::uint64_t bits(double x) {
  std::uint64_t r;
  std::memcpy(&r, &x, sizeof r);
  return r;
}

// (c)
void require_same(const Communicator& comm, const char* name, const Options& o,
                  std::initializer_list<double> numbers) {
  std::uint64_t call = 1, arguments = 1;
  for (; *name != '\0'; ++name) call = mix(call, std::uint64_t(*name));
  for (const double x : numbers) arguments = mix(arguments, bits(x));
  comm.require_same({{"the call that is made", call},
                     {"tolerance", bits(o.tolerance.value_or(-1))},
                     {"relative_tolerance", bits(o.relative_tolerance)},
                     {"min_separation", bits(o.min_separation)},
                     {"window", bits(o.window)},
                     {"norm", std::uint64_t(o.norm)},
                     {"exactness", std::uint64_t(o.exactness)},
                     {"touching_may_pass_through", std::uint64_t(o.touching_may_pass_through)},
                     {"narrow_phase", std::uint64_t(o.narrow_phase)},
                     {"max_checks", std::uint64_t(o.max_checks)},
                     {"d_hat, or another number that the call takes,", arguments}});
}

std::optional<FoundPair> found(const SceneLimits::Limit& limit) {
  return limit.known ? std::optional(limit.found) : std::nullopt;
}

SceneLimits::Limit in_scene(const Part& part, const std::optional<FoundPair>& found) {
  SceneLimits::Limit r{};
  if (!found) return r;
  r.known = true, r.found = *found;
  Pair pair{found->kind, found->result.pair.a, found->result.pair.b,
            pair_vertices(part.mesh.data(), found->kind, found->result.pair)};
  part.rename(pair);
  r.found.result.pair = {pair.a, pair.b}, r.vertices = pair.vertices;
  return r;
}

Limits to_limits(const SceneLimits& s) { return {found(s.contact), found(s.stored), found(s.clear)}; }

bool is_same(const FoundPair& x, const SceneLimits::Limit& y) {
  return y.known && x.kind == y.found.kind && x.result.pair.a == y.found.result.pair.a &&
         x.result.pair.b == y.found.result.pair.b;
}

// Keeps the first of two by the order of Limits::add.
void keep_first(SceneLimits& into, const SceneLimits& from) {
  Limits both = to_limits(into);
  both.add(to_limits(from));
  if (both.contact && !is_same(*both.contact, into.contact)) into.contact = from.contact;
  if (both.stored && !is_same(*both.stored, into.stored)) into.stored = from.stored;
  if (both.clear && !is_same(*both.clear, into.clear)) into.clear = from.clear;
}

}  // namespace

// Every call begins with the same two messages, so that ranks in different ones find out.
void begin_call(const Mesh::Impl& m, const char* name, const Options& options,
                std::initializer_list<double> numbers, FunctionRef<> check_more) {
  m.comm.reset_traffic();
  m.comm.agreed([&] {
    check(options);
    check_more();
    if (options.check_limit < std::numeric_limits<std::int64_t>::max())
      throw std::invalid_argument("check_limit is not offered over ranks");
  });
  require_same(m.comm, name, options, numbers);
}

void end_call(const Mesh::Impl& m, std::int64_t pairs) {
  m.exchange.bytes_sent = m.comm.traffic().bytes, m.exchange.messages_sent = m.comm.traffic().messages;
  m.exchange.pairs = pairs;
}

Outcome agreed_outcome(const Communicator& comm, Outcome mine) {
  constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
  std::int64_t first = mine == Outcome::free ? kNone : std::int64_t(comm.rank()) << 8 | std::int64_t(mine);
  comm.minimum(&first, 1);
  return first == kNone ? Outcome::free : Outcome(first & 0xff);
}

SceneLimits reduce(const Communicator& comm, const Part& part, const Limits& limits) {
  SceneLimits all{in_scene(part, limits.contact), in_scene(part, limits.stored),
                  in_scene(part, limits.clear)};
  comm.reduce(all, keep_first);
  return all;
}

void limit_step(const SceneLimits& scene, double upper, StepResult& r) {
  const Limits limits = to_limits(scene);
  const FoundPair* limiting = onset::limit_step(limits, upper, upper, r);
  if (limiting == nullptr) return;
  const SceneLimits::Limit& of = limits.stored && limiting == &*limits.stored ? scene.stored : scene.clear;
  r.limiting = Pair{limiting->kind, limiting->result.pair.a, limiting->result.pair.b, of.vertices};
}

void reduce(const Communicator& comm, Stats& s) {
  std::int64_t sums[24], *next = sums;
  const auto each_sum = [&](const auto& f) {
    for (PairCounts* c : {&s.candidates, &s.after_culls, &s.inclusion, &s.gave_up, &s.contacts})
      f(c->vertex_face), f(c->edge_edge), f(c->vertex_edge), f(c->vertex_plane);
    f(s.checks);
  };
  each_sum([&](std::int64_t& x) { *next++ = x; });
  comm.sum(sums, int(next - sums));
  next = sums;
  each_sum([&](std::int64_t& x) { x = *next++; });
  comm.sum(s.checks_histogram.data(), int(s.checks_histogram.size()));
  comm.maximum(&s.max_checks_of_a_pair, 1);
  double* const largest[] = {&s.seconds_broad, &s.seconds_narrow, &s.seconds_contacts, &s.seconds_total,
                             &s.achieved_tolerance};
  double values[5];
  for (std::size_t i = 0; i < 5; ++i) values[i] = *largest[i];
  comm.maximum(values, 5);
  for (std::size_t i = 0; i < 5; ++i) *largest[i] = values[i];
  comm.minimum(&s.looked_at, 1);
  s.worst.reset();  // of one part
}

}  // namespace onset::mpi
