#include <algorithm>
#include <cmath>
#include <thread>

#include "files/output.hpp"
#include "files/queries/truth_file.hpp"
#include "measure/system.hpp"
#include "onset/results/report.hpp"
#include "onset/trade/subject.hpp"

namespace app {
namespace {

struct Found {
  std::uint64_t key;
  double toi;
};

std::vector<Found> found(const onset::ActiveSet& set) {
  std::vector<Found> rows;
  for (const onset::Contact& c : set) rows.push_back({pair_key(c.kind, c.a, c.b), c.toi});
  return rows;
}

// Calls both(x, y) for rows with the same key, only_x(x) for those of xs alone; both sorted by key.
template <class X, class Y, class Both, class OnlyX>
void match(const std::vector<X>& xs, const std::vector<Y>& ys, Both&& both, OnlyX&& only_x) {
  auto y = ys.begin();
  for (const X& x : xs) {
    while (y != ys.end() && y->key < x.key) ++y;
    if (y != ys.end() && y->key == x.key)
      both(x, *y);
    else
      only_x(x);
  }
}

class SceneSubject : public Subject {
 public:
  SceneSubject(const std::string& a, const std::string& b, const std::vector<std::string>& truth,
               const onset::Options& base)
      : name_(a + " " + b), scene_(read_scene(a, b)), truth_(read_scene_truth(truth, scene_.mesh)) {
    has_truth_ = !truth.empty();
    for (const CollidingPair& pair : truth_) exact_times_ += pair.toi.known();
    reference_options_ = finest(base);
    const onset::ActiveSet set = active_set(reference_options_);
    extent_ = set.stats.extent;
    reference_ = found(set);
  }

  Grounds grounds() const override {
    const onset::Mesh& m = scene_.mesh;
    return {extent_, m.num_vertices() + m.num_edges() + m.num_faces(),
            int(std::max(1u, std::thread::hardware_concurrency()))};
  }
  std::string describe() const override {
    std::string text = name_ + ": " + describe_sizes(scene_.mesh).substr(12);
    for (const std::string& note : scene_.notes) text += "note        " + note + "\n";
    return text;
  }
  std::string reference() const override {
    if (exact_times_ > 0)
      return format("the exact times of %lld pairs", static_cast<long long>(exact_times_));
    return format("the times at %s", in_words(reference_options_).c_str());
  }
  const char* unit() const override { return "wall time of one active set"; }

  void answer(Measured& m) override {
    onset::ActiveSet set;
    m.answers.peak_bytes = peak_bytes([&] { set = active_set(m.setting.options); });
    fill(m.answers, set, m.setting.options);
  }

  void time(Measured& m) override {
    const Stopwatch watch;
    const onset::ActiveSet set = active_set(m.setting.options);
    const Seconds seconds = watch.elapsed();
    m.wall.push_back(1e6 * seconds.wall), m.cpu.push_back(1e6 * seconds.cpu);
    m.us = m.wall;
    note_end(m.answers, set);
  }

 private:
  onset::ActiveSet active_set(const onset::Options& options) const {
    return onset::construct_active_set(scene_.mesh, scene_.x_t0, scene_.x_t1, options);
  }

  // Of several calls the one that a clock cut off soonest counts.
  static void note_end(Answers& a, const onset::ActiveSet& set) {
    if (!(set.complete_until < a.complete_until)) return;
    a.complete_until = set.complete_until, a.incomplete = set.outcome;
  }

  void fill(Answers& a, const onset::ActiveSet& set, const onset::Options& options) const {
    const onset::Stats& s = set.stats;
    a.asked = s.candidates.total(), a.positives = std::int64_t(set.size());
    for (const onset::Contact& c : set) a.certain += c.certainty != onset::Certainty::within_tolerance;
    a.budget = s.gave_up.total(), a.inclusion = s.inclusion.total(), a.checks = s.checks;
    a.tolerance = s.tolerance, a.achieved_tolerance = s.achieved_tolerance;
    if (const onset::Contact* first = set.earliest()) a.earliest = first->toi;
    note_end(a, set);
    const std::vector<Found> rows = found(set);
    if (has_truth_) compare_with_truth(a, rows, options);
    if (exact_times_ == 0 && same_question(options, reference_options_)) {
      a.early.emplace();
      match(
          reference_, rows,
          [&](const Found& exact, const Found& row) { a.early->add(row.toi, exact.toi, 1); },
          [](const Found&) {});
    }
  }

  // Whoever touches comes within any separation too, so that missing it, or being late, is wrong for any. A
  // set that is complete until some time has all that touch for certain by then.
  void compare_with_truth(Answers& a, const std::vector<Found>& rows, const onset::Options& options) const {
    std::int64_t hits = 0, misses = 0;
    Earliness early;
    match(
        truth_, rows,
        [&](const CollidingPair& pair, const Found& row) {
          ++hits;
          if (pair.toi.known()) early.add(row.toi, pair.toi.lo, pair.toi.hi);
        },
        [&](const CollidingPair& pair) {
          misses += a.complete_until == INFINITY || pair.toi.hi < a.complete_until;
        });
    a.false_negatives = misses;
    if (exact_times_ > 0) a.early = early;
    if (options.min_separation == 0) a.false_positives = a.positives - hits;
  }

  std::string name_;
  Scene scene_;
  SceneTruth truth_;
  bool has_truth_ = false;
  std::int64_t exact_times_ = 0;
  double extent_ = 1;
  onset::Options reference_options_;
  std::vector<Found> reference_;
};

}  // namespace

std::unique_ptr<Subject> scene_subject(const std::string& a, const std::string& b,
                                       const std::vector<std::string>& truth, const onset::Options& base) {
  return std::make_unique<SceneSubject>(a, b, truth, base);
}

}  // namespace app
