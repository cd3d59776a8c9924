#include "src/trajectory/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "broadphase/box_test.hpp"
#include "scene/motion/extents.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pair_source.hpp"
#include "src/shared/contacts.hpp"
#include "src/shared/find_contacts.hpp"
#include "src/shared/step_setup.hpp"
#include "src/trajectory/proof.hpp"
#include "src/trajectory/reach.hpp"

namespace onset {
namespace {

// Shorter pieces than this get no tree of their own: what is left of longer ones is few enough.
constexpr double kShortestOfAll = 0x1p-6;

// A pair that a piece leaves undecided.
struct Pending {
  PairKind kind;
  IdPair pair;
  double from;  // free until then
  bool apart;   // known to be apart at the start of the step
};

// A piece of time, and the pairs to decide in it, sorted by `before`.
struct Frame {
  double t0, t1;
  std::vector<Pending> pairs;
};

class Refinement {
 public:
  Refinement(const TurningQuestion& question, Budget& budget)
      : q_(question),
        budget_(budget),
        pieces_(question.scene, question.trajectory, question.x0, question.x1),
        options_(question.options),
        until_(question.until) {
    options_.exactness = Exactness::conservative;
    options_.window = std::numeric_limits<double>::infinity();
  }

  TurningAnswer run() {
    if (prepare() && !alone_) {
      double length = 1;
      for (double t0 = 0; t0 < 1 && t0 <= until_ && !ended(); t0 += length) length = piece(t0, length);
    }
    if (const Fault& fault = pieces_.fault(); fault.outcome != Outcome::free)
      a_.outcome = fault.outcome, a_.vertex = fault.vertex;
    if (ended() && a_.outcome != Outcome::out_of_memory) a_.complete_until = std::min(a_.complete_until, 0.0);
    return std::move(a_);
  }

 private:
  const MeshData& data() const { return *q_.scene.pieces; }
  bool ended() const {
    return a_.outcome != Outcome::free || pieces_.fault().outcome != Outcome::free ||
           budget_.outcome() != Outcome::free || (q_.collect == Collect::any && !a_.contacts.empty());
  }
  bool set(double t0, double t1, const std::vector<int>& vertices) {
    return pieces_.set(t0, t1, vertices) && !budget_.spent();
  }

  bool prepare();
  double piece(double t0, double length);
  void decide_all();
  void refine(Frame&& whole);
  TraversalResult decide(const PairSource& pairs);
  void count(const TraversalResult& traversal);
  std::vector<Pending> sort_out(const std::vector<FoundPair>& found, const std::vector<Pending>& asked);
  bool is_done(const FoundPair& f, const std::array<int, 4>& vertices, bool at_start);
  void look_at_start(std::vector<Pending>& pairs);
  void report(FoundPair f, double t, double share, double added);
  void add_geometry(Contact& contact, double share) const;

  const TurningQuestion& q_;
  Budget& budget_;
  Pieces pieces_;
  Options options_;
  // Later contacts are not looked for.
  double until_;
  std::shared_ptr<BroadPhase> broad_;
  BoxTest test_ = BoxTest::both_ends;
  std::unordered_set<std::uint64_t> reported_;
  // One rigid body, with nothing in its reach.
  bool alone_ = false;
  TurningAnswer a_;
};

// Lists what can be reached, and sets the lengths that all pieces work by.
bool Refinement::prepare() {
  if (!set(0, 1, q_.scene.turning_vertices)) return false;
  const double tolerance = options_.tolerance.value_or(0);
  const double strays = pieces_.largest_bound();
  const auto near = within_reach(q_.scene, pieces_.motion(), q_.x0, q_.x1, strays,
                                 largest_separation(q_.mesh.data(), options_) + tolerance);
  alone_ = q_.scene.is_one_body && near[0].empty() && near[1].empty() && near[2].empty();
  q_.scene.list(near);
  if (!set(0, 1, q_.scene.filter->moving_vertices)) return false;
  const Extents extents =
      corner_extents(data(), pieces_.motion(), largest_separation(q_.mesh.data(), options_));
  a_.extent = extents.largest() + pieces_.largest_bound();  // a whole turn has chords without length
  a_.tolerance = absolute_tolerance(options_, a_.extent);
  options_.tolerance = std::max(0.25 * a_.tolerance, 0x1p-1074);
  double largest = 0;
  for (const int v : q_.scene.filter->moving_vertices)
    for (int a = 0; a < 3; ++a)
      largest =
          std::max({largest, std::fabs(pieces_.motion().t0(v)[a]), std::fabs(pieces_.motion().t1(v)[a])});
  const double most = pieces_.largest_rounding(q_.scene.turning_vertices);
  a_.rounding = (kStoring * (largest + strays) + 2 * most + 0x1p-1070) * (1 + 0x1p-50);
  return !ended();
}

// Decides a piece of the whole scene from t0 on, of this length or less, which is a power of two that t0 is a
// multiple of. Returns the length of the next one, having been passed.
double Refinement::piece(double t0, double length) {
  const auto is_multiple = [&](double l) { return std::fmod(t0, l) == 0 && t0 + l <= 1; };
  if (is_multiple(2 * length)) length *= 2;
  for (;; length *= 0.5) {
    if (!set(t0, t0 + length, q_.scene.turning_vertices)) return length;
    if (length <= kShortestOfAll || !pieces_.is_coarse(q_.scene.turning_vertices, 0.25 * a_.tolerance)) break;
  }
  if (set(t0, t0 + length, q_.scene.filter->moving_vertices)) decide_all();
  return length;
}

void Refinement::decide_all() {
  const MeshData& mesh = data();
  if (!broad_) test_ = cheaper_box_test(mesh, pieces_.motion());
  const double margin = reported_within(*options_.tolerance, a_.extent);
  const BroadPhaseInput input = broad_phase_input(mesh, pieces_.motion(), options_, margin, 1, test_);
  if (broad_ && broad_->suits(pieces_.motion()))
    broad_->refit(input, budget_.stop());
  else
    broad_ = make_broad_phase(options_.broad_phase, input, budget_.stop());
  if (!broad_ || budget_.spent()) return;
  Frame whole{pieces_.t0(), pieces_.t1(), {}};
  const TraversalResult traversal = decide(*broad_);
  whole.pairs = sort_out(traversal.found, {});
  refine(std::move(whole));
}

// Decides pairs on the piece that is set: one more than memory has room for, so that it is noticed.
TraversalResult Refinement::decide(const PairSource& pairs) {
  NarrowPhaseInput input{data(), pieces_.motion(), *options_.tolerance, a_.extent, options_};
  const Straying straying{q_.scene.thickness, pieces_.bounds()};
  input.straying = &straying;
  const std::size_t most = most_contacts(options_);
  TraversalBounds bounds;
  if (options_.memory_limit < std::numeric_limits<std::int64_t>::max()) bounds.most = most + 1;
  TraversalResult r = traverse_pairs(pairs, NarrowPhase(input), Collect::all, 1, budget_, 1, bounds);
  count(r);
  if (r.found.size() > most) {
    a_.outcome = Outcome::out_of_memory;
    a_.complete_until = pieces_.t0();
  }
  return r;
}

void Refinement::count(const TraversalResult& traversal) {
  a_.counts.vertex_face.add(traversal.vertex_face);
  a_.counts.edge_edge.add(traversal.edge_edge);
}

// Halves pieces, the earlier half first, until nothing is left undecided. A pair goes into the earlier half
// only where it is not known to be free there.
void Refinement::refine(Frame&& whole) {
  std::vector<Frame> stack;
  const auto halve = [&](double t0, double t1, std::vector<Pending>&& pairs) {
    if (pairs.empty()) return;
    const double middle = t0 + 0.5 * (t1 - t0);
    Frame earlier{t0, middle, {}};
    for (const Pending& p : pairs)
      if (p.from < middle) earlier.pairs.push_back(p);
    stack.push_back({middle, t1, std::move(pairs)});
    if (!earlier.pairs.empty()) stack.push_back(std::move(earlier));
  };
  halve(whole.t0, whole.t1, std::move(whole.pairs));
  std::vector<int> vertices;
  while (!stack.empty() && !ended()) {
    Frame frame = std::move(stack.back());
    stack.pop_back();
    if (frame.t0 > until_) continue;
    PairList list;
    vertices.clear();
    for (const Pending& p : frame.pairs) {
      if (reported_.count(order_of(p.kind, p.pair)) > 0) continue;
      list.of(p.kind).push_back(p.pair);
      for (const int v : pair_vertices(data(), p.kind, p.pair)) vertices.push_back(v);
    }
    if (vertices.empty()) continue;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    if (!set(frame.t0, frame.t1, vertices)) return;
    const TraversalResult traversal = decide(list);
    if (ended()) return;
    halve(frame.t0, frame.t1, sort_out(traversal.found, frame.pairs));
  }
}

// Reports what is decided and returns the rest. `asked`: what is known of the pairs; empty: nothing is.
std::vector<Pending> Refinement::sort_out(const std::vector<FoundPair>& found,
                                          const std::vector<Pending>& asked) {
  std::vector<Pending> rest, at_start;
  auto known = asked.begin();
  for (const FoundPair& f : found) {
    if (ended()) return {};
    const std::uint64_t order = order_of(f.kind, f.result.pair);
    while (known != asked.end() && order_of(known->kind, known->pair) < order) ++known;
    if (!q_.scene.is_of_pieces(f.kind, f.result.pair) || q_.scene.is_of_one_body(f.kind, f.result.pair) ||
        reported_.count(order) > 0)
      continue;
    const double t = pieces_.time_at(f.result.toi);
    if (t > until_) continue;
    const bool start = t == 0 && f.result.toi == 0;
    const bool apart = known != asked.end() && known->apart;
    const std::array<int, 4> vertices = pair_vertices(data(), f.kind, f.result.pair);
    if (start && !apart)
      at_start.push_back({f.kind, f.result.pair, 0, true});
    else if (is_done(f, vertices, start))
      report(f, t, f.result.toi, pieces_.added(vertices, f.kind));
    else
      rest.push_back({f.kind, f.result.pair, t, apart});
  }
  if (!at_start.empty()) {
    look_at_start(at_start);
    std::vector<Pending> both;
    const auto comes_before = [](const Pending& x, const Pending& y) {
      return order_of(x.kind, x.pair) < order_of(y.kind, y.pair);
    };
    std::merge(rest.begin(), rest.end(), at_start.begin(), at_start.end(), std::back_inserter(both),
               comes_before);
    rest = std::move(both);
  }
  return rest;
}

// Says whether a pair is reported as it is: within the tolerance, or as halves would find it too.
bool Refinement::is_done(const FoundPair& f, const std::array<int, 4>& vertices, bool at_start) {
  const double added = pieces_.added(vertices, f.kind);
  if (!pieces_.divisible()) return true;
  return (!at_start && added <= 0.25 * a_.tolerance) || added <= 1.5 * pieces_.rounding(vertices, f.kind);
}

// Reports the pairs that touch, or are within their separation, at the start, and keeps the others.
void Refinement::look_at_start(std::vector<Pending>& pairs) {
  const Motion rest = standing_still(q_.x0);
  PairList list;
  for (const Pending& p : pairs) list.of(p.kind).push_back(p.pair);
  std::vector<double> thickness = q_.scene.thickness;
  q_.scene.pieces->thickness.swap(thickness);
  Options options = options_;
  options.exactness = q_.options.exactness;
  const NarrowPhase narrow({data(), rest, *options_.tolerance, a_.extent, options});
  const TraversalResult traversal = traverse_pairs(list, narrow, Collect::all, 1, budget_);
  q_.scene.pieces->thickness.swap(thickness);
  count(traversal);
  auto left = pairs.begin();
  auto found = traversal.found.begin();
  for (const Pending& p : pairs) {
    const std::uint64_t order = order_of(p.kind, p.pair);
    while (found != traversal.found.end() && before(*found, {p.kind, {p.pair, 0, 0, 0, PairOutcome::free}}))
      ++found;
    if (found != traversal.found.end() && order_of(found->kind, found->result.pair) == order)
      report(*found, 0, 0, 0);
    else
      *left++ = p;
  }
  pairs.erase(left, pairs.end());
}

// Reports a pair at time t, when `share` of the piece that is set has gone by.
void Refinement::report(FoundPair f, double t, double share, double added) {
  PairResult& r = f.result;
  const bool at_start = t == 0;
  if (r.outcome == PairOutcome::initial_separating) r.outcome = PairOutcome::initial_contact;
  if (added > 0 || !at_start) {  // else it is what a look at the start found
    r.outcome = at_start                               ? PairOutcome::below_rounding
                : r.outcome == PairOutcome::max_checks ? PairOutcome::max_checks
                                                       : PairOutcome::contact;
    r.certainty = Certainty::within_tolerance;
    r.toi_hi = INFINITY;
    r.tolerance += 2 * added;
  }
  r.toi = r.step_limit = t;
  Contact contact;
  static_cast<Pair&>(contact) = to_pair(q_.mesh, f);
  put(r, contact);
  if (q_.collect == Collect::all) add_geometry(contact, share);
  if (q_.collect == Collect::all && t > 0 && q_.options.exactness != Exactness::conservative)
    prove(pieces_, q_.scene.thickness, options_.min_separation, contact);
  reported_.insert(order_of(f.kind, r.pair));
  a_.contacts.push_back(contact);
  until_ = std::min(until_, q_.collect == Collect::all ? t + q_.options.window : t);
}

void Refinement::add_geometry(Contact& contact, double share) const {
  const ContactGeometry geometry =
      contact_geometry(contact.kind, pieces_.motion(), contact.vertices, share, false);
  put(geometry, contact);
  contact.speed /= pieces_.t1() - pieces_.t0();
}

}  // namespace

TurningAnswer refine(const TurningQuestion& question, Budget& budget) {
  return Refinement(question, budget).run();
}

}  // namespace onset
