#include "onset/trade/setting.hpp"

#include <algorithm>
#include <cmath>

#include "files/output.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

using onset::BroadPhaseMethod, onset::Exactness, onset::InstructionSet, onset::NarrowPhaseMethod, onset::Norm,
    onset::Options;

// Brute force over more than this takes longer than everything else together.
constexpr std::ptrdiff_t kBrutePrimitives = 20000;

// The separation at which norms are compared where the base has none, as a share of the extent.
constexpr double kSomeSeparation = 1e-4;

class Axis {
 public:
  Axis(std::string name, const Options& base) : name_(std::move(name)), base_(base) {}

  template <class Change>
  void add(const std::string& value, Change&& change, bool same_question = true) {
    Setting s{name_, value, base_, same_question};
    change(s.options);
    settings_.push_back(s);
  }
  std::vector<Setting> take() { return std::move(settings_); }

 private:
  std::string name_;
  const Options& base_;
  std::vector<Setting> settings_;
};

// Of the two tolerances the one that is in force.
double& tolerance_of(Options& o) { return o.tolerance ? *o.tolerance : o.relative_tolerance; }

// Adds the setting whose tolerance is that of the base times `factor`, if a tolerance is what that is.
template <class Change>
void add_tolerance(Axis& axis, Options o, double factor, const std::string& name, Change&& change) {
  const double value = tolerance_of(o) * factor;
  if (!(value > 0 && std::isfinite(value))) return;
  axis.add(name + format("%.3g", value) + (o.tolerance ? "" : " relative"),
           [&](Options& changed) { tolerance_of(changed) = value, change(changed); });
}

void tolerance(Axis& axis, const Options& base, const Grounds&) {
  for (const double factor : {1e5, 1e4, 1e3, 1e2, 1e1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6})
    add_tolerance(axis, base, factor, "", [](Options&) {});
}

void max_checks(Axis& axis, const Options& base, const Grounds&) {
  for (const std::int64_t checks : {1, 3, 10, 30, 100, 1000, 10000, 100000, 1000000})
    if (checks != base.max_checks)
      axis.add(std::to_string(checks), [&](Options& o) { o.max_checks = checks; });
}

void min_separation(Axis& axis, const Options& base, const Grounds& grounds) {
  for (const double share : {0.0, 1e-16, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3}) {
    const double d = share * grounds.extent;
    if (d != base.min_separation)
      axis.add(
          format("%.3g", d), [&](Options& o) { o.min_separation = d; }, false);
  }
}

void norm(Axis& axis, const Options& base, const Grounds& grounds) {
  const double d = base.min_separation > 0 ? base.min_separation : kSomeSeparation * grounds.extent;
  for (const Norm n : {Norm::euclidean, Norm::maximum}) {
    if (n == base.norm && d == base.min_separation) continue;
    axis.add(
        format("%s, separation %.3g", norm_name(n), d), [&](Options& o) { o.norm = n, o.min_separation = d; },
        false);
  }
}

// The paper's root finder alone, for which the tolerance decides how fine its boxes get.
void narrow_phase(Axis& axis, const Options& base, const Grounds&) {
  for (const double factor : {1e4, 1e2, 1e0, 1e-2})
    add_tolerance(axis, base, factor, "inclusion, ",
                  [](Options& o) { o.narrow_phase = NarrowPhaseMethod::inclusion; });
  if (base.narrow_phase != NarrowPhaseMethod::automatic)
    axis.add("automatic", [](Options& o) { o.narrow_phase = NarrowPhaseMethod::automatic; });
}

void broad_phase(Axis& axis, const Options& base, const Grounds& grounds) {
  if (grounds.primitives == 0) return;
  for (const auto& [name, method] :
       {std::pair{"automatic", BroadPhaseMethod::automatic}, std::pair{"bvh", BroadPhaseMethod::bvh},
        std::pair{"hash", BroadPhaseMethod::hash}, std::pair{"brute", BroadPhaseMethod::brute}}) {
    const bool too_slow = method == BroadPhaseMethod::brute && grounds.primitives > kBrutePrimitives;
    if (method != base.broad_phase && !too_slow)
      axis.add(name, [&, m = method](Options& o) { o.broad_phase = m; });
  }
}

void threads(Axis& axis, const Options& base, const Grounds& grounds) {
  if (grounds.primitives == 0) return;
  for (int n = 1; n <= grounds.cores; n *= 2)
    if (n != base.threads) axis.add(std::to_string(n), [&](Options& o) { o.threads = n; });
}

void certainty(Axis& axis, const Options& base, const Grounds&) {
  for (const auto& [name, level] :
       {std::pair{"conservative", Exactness::conservative}, std::pair{"certify", Exactness::certify},
        std::pair{"exact", Exactness::exact}})
    if (level != base.exactness) axis.add(name, [l = level](Options& o) { o.exactness = l; });
}

void kernel(Axis& axis, const Options& base, const Grounds&) {
  if (base.instruction_set != InstructionSet::scalar)
    axis.add("scalar", [](Options& o) { o.instruction_set = InstructionSet::scalar; });
}

struct NamedAxis {
  const char* name;
  void (*fill)(Axis&, const Options&, const Grounds&);
};
constexpr NamedAxis kAxes[] = {{"tolerance", tolerance},
                               {"max-checks", max_checks},
                               {"min-separation", min_separation},
                               {"norm", norm},
                               {"certainty", certainty},
                               {"narrow-phase", narrow_phase},
                               {"broad-phase", broad_phase},
                               {"threads", threads},
                               {"kernel", kernel}};

const char* word(NarrowPhaseMethod m) {
  return m == NarrowPhaseMethod::inclusion ? "NarrowPhaseMethod::inclusion" : "NarrowPhaseMethod::automatic";
}
const char* word(BroadPhaseMethod m) {
  return m == BroadPhaseMethod::bvh     ? "BroadPhaseMethod::bvh"
         : m == BroadPhaseMethod::hash  ? "BroadPhaseMethod::hash"
         : m == BroadPhaseMethod::brute ? "BroadPhaseMethod::brute"
                                        : "BroadPhaseMethod::automatic";
}
const char* word(InstructionSet k) {
  return k == InstructionSet::scalar   ? "InstructionSet::scalar"
         : k == InstructionSet::avx2   ? "InstructionSet::avx2"
         : k == InstructionSet::avx512 ? "InstructionSet::avx512"
                                       : "InstructionSet::automatic";
}
const char* word(Exactness c) {
  return c == Exactness::exact     ? "Exactness::exact"
         : c == Exactness::certify ? "Exactness::certify"
                                   : "Exactness::conservative";
}

}  // namespace

const std::vector<std::string>& axis_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const NamedAxis& axis : kAxes) all.push_back(axis.name);
    return all;
  }();
  return names;
}

std::vector<Setting> settings(const Options& base, const std::vector<std::string>& axes,
                              const Grounds& grounds) {
  std::vector<Setting> all{{"base", "", base, true}};
  for (const NamedAxis& named : kAxes) {
    if (std::find(axes.begin(), axes.end(), named.name) == axes.end()) continue;
    Axis axis(named.name, base);
    named.fill(axis, base, grounds);
    for (Setting& s : axis.take()) all.push_back(std::move(s));
  }
  return all;
}

std::string in_words(const Options& o) {
  const Options defaults;
  std::string text;
  const auto say = [&](bool differs, const std::string& words) {
    if (differs) text += (text.empty() ? "" : ", ") + words;
  };
  say(o.tolerance.has_value(), format("tolerance = %.3g", o.tolerance.value_or(0)));
  say(o.relative_tolerance != defaults.relative_tolerance,
      format("relative_tolerance = %.3g", o.relative_tolerance));
  say(o.min_separation != defaults.min_separation, format("min_separation = %.17g", o.min_separation));
  say(o.norm != defaults.norm, std::string("norm = Norm::") + norm_name(o.norm));
  say(o.max_checks != defaults.max_checks, format("max_checks = %lld", static_cast<long long>(o.max_checks)));
  say(o.threads != defaults.threads, format("threads = %d", o.threads));
  say(o.broad_phase != defaults.broad_phase, std::string("broad_phase = ") + word(o.broad_phase));
  say(o.narrow_phase != defaults.narrow_phase, std::string("narrow_phase = ") + word(o.narrow_phase));
  say(o.exactness != defaults.exactness, std::string("exactness = ") + word(o.exactness));
  say(o.instruction_set != defaults.instruction_set,
      std::string("instruction_set = ") + word(o.instruction_set));
  return text.empty() ? "the defaults" : text;
}

}  // namespace app
