// What settings are tried on: a scene, or queries; and the round of tries.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <onset/onset.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/scene/scene.hpp"
#include "measure/timing.hpp"
#include "onset/trade/setting.hpp"

namespace app {

// How much earlier than a reference the times of impact are, in units of the step.
struct Earliness {
  std::int64_t pairs = 0;  // compared
  double sum = 0, most = 0;
  std::int64_t zero = 0;  // of them: 0 although the reference is later
  std::int64_t late = 0;  // of them: later than an exact reference

  void add(double toi, double lo, double hi) {
    ++pairs;
    sum += lo > toi ? lo - toi : 0;
    most = lo - toi > most ? lo - toi : most;
    zero += toi == 0 && lo > 0;
    late += toi > hi;
  }
  double mean() const { return pairs ? sum / double(pairs) : 0; }
};

// What one setting answers, whatever the time it takes.
struct Answers {
  std::int64_t asked = 0;  // candidates of a scene, or queries
  std::int64_t positives = 0, budget = 0, inclusion = 0, checks = 0;
  std::int64_t certain = 0;                                      // of the positives: known to be contacts
  std::optional<std::int64_t> false_positives, false_negatives;  // where the truth is known for this question
  std::optional<Earliness> early;                                // where there is a reference
  double tolerance = 0;                                          // asked for; of queries: the largest
  double achieved_tolerance = 0;                                 // the largest distance beyond the separation
  double earliest = 1;                                           // time of impact of all
  std::optional<std::int64_t> peak_bytes;
  // Of a scene's set that a budget cut off: why, and until when all contacts are there. It has no place on
  // the front: what is not there is not counted.
  std::optional<onset::Outcome> incomplete;
  double complete_until = INFINITY;
};

// Everything that is known of one setting.
struct Measured {
  Setting setting;
  Answers answers;
  // Microseconds of one call, or of one query on average. `us` is what counts: wall time of a scene, CPU time
  // of queries, which are short and asked by one thread.
  std::vector<double> us, wall, cpu;
  std::vector<double> best_us;  // of each query: the shortest of all measurements
  std::vector<bool> collides;   // its answer
};

class Subject {
 public:
  virtual ~Subject() = default;
  virtual Grounds grounds() const = 0;
  virtual std::string describe() const = 0;   // name and size, one line
  virtual std::string reference() const = 0;  // what times are compared with, where separation and norm allow
  virtual const char* unit() const = 0;       // what the time is of
  virtual void answer(Measured& m) = 0;       // fills m.answers
  virtual void time(Measured& m) = 0;         // adds one measurement
};

// `truth`: files for read_scene_truth, may be empty. `base` is what the reference is derived from.
std::unique_ptr<Subject> scene_subject(const std::string& a, const std::string& b,
                                       const std::vector<std::string>& truth, const onset::Options& base);
// `kind`: "vf", "ee" or empty for what each path tells.
std::unique_ptr<Subject> query_subject(const std::vector<std::string>& files, const std::string& kind,
                                       const onset::Options& base);

// The finest setting there is, which stands for the exact times where those are not known, and is not cut off
// by time or checks.
onset::Options finest(onset::Options base);

// Whether two settings ask for the same distance.
inline bool same_question(const onset::Options& a, const onset::Options& b) {
  return a.min_separation == b.min_separation && (a.norm == b.norm || a.min_separation == 0);
}

struct SweepPlan {
  int repeats = 9;
  double seconds = 5;  // a setting is measured once, and again as long as this is not spent on it
};

// Tries every setting: one round for the answers, which warms up too, then rounds over all settings in turn,
// so that what drifts on the machine meets them all. `done` is called after each call.
std::vector<Measured> sweep(Subject& subject, const std::vector<Setting>& settings, const SweepPlan& plan,
                            const std::function<void()>& done);

}  // namespace app
