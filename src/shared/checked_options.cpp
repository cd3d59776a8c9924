#include "src/shared/checked_options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/float_environment.hpp"
#include "base/text_stream.hpp"
#include "scene/motion/extents.hpp"
#include "scene/pairs/separation.hpp"

namespace onset {
namespace {

[[noreturn]] void reject(const char* name, double value, const char* wanted) {
  TextStream s;
  s.precision(17);
  s << name << " is " << value << "; it must be " << wanted;
  throw std::invalid_argument(s.str());
}

constexpr int kMostThreads = 4096;

template <class E>
void check_enum(const char* name, E value, E last) {
  if (int(value) < 0 || value > last) reject(name, double(int(value)), "one of the enumerators");
}

void check_all(const Options& o) {
  if (o.tolerance && !(*o.tolerance > 0 && std::isfinite(*o.tolerance)))
    reject("tolerance", *o.tolerance, "a finite number > 0");
  if (!(o.relative_tolerance > 0 && std::isfinite(o.relative_tolerance)))
    reject("relative_tolerance", o.relative_tolerance, "a finite number > 0");
  if (!(o.min_separation >= 0 && o.min_separation <= kMaxCoordinate))
    reject("min_separation", o.min_separation, "a number >= 0, at most 2^1020");
  if (o.max_checks < 1) reject("max_checks", double(o.max_checks), "at least 1");
  if (!(o.window >= 0)) reject("window", o.window, "a number >= 0, or infinite");
  if (!(o.time_limit >= 0)) reject("time_limit", o.time_limit, "a number >= 0, or infinite");
  if (o.check_limit < 0) reject("check_limit", double(o.check_limit), "at least 0");
  if (o.memory_limit < 0) reject("memory_limit", double(o.memory_limit), "at least 0");
  if (o.threads < 0 || o.threads > kMostThreads)
    reject("threads", o.threads, "at least 1 and at most 4096, or 0 for the caller's arena");
  check_enum("norm", o.norm, Norm::maximum);
  check_enum("broad_phase", o.broad_phase, BroadPhaseMethod::brute);
  check_enum("narrow_phase", o.narrow_phase, NarrowPhaseMethod::inclusion);
  check_enum("exactness", o.exactness, Exactness::exact);
}

void check_share(double gap_share) {
  if (!(gap_share >= 0 && gap_share < 1)) reject("gap_share", gap_share, "in [0, 1)");
}

}  // namespace

// A comparison with NaN is an invalid operation, which the host may trap.
void check(const Options& options) { in_float_environment(check_all, options); }
void check_gap_share(double gap_share) { in_float_environment(check_share, gap_share); }

double largest_separation(const MeshData& mesh, const Options& options) {
  const double of_bodies = largest_of_bodies(mesh, options);
  if (!has_thickness(mesh)) return of_bodies;
  return with_thickness(of_bodies, thickest(mesh), thickest(mesh));
}

double absolute_tolerance(const Options& options, double extent) {
  if (options.tolerance) return *options.tolerance;
  return std::clamp(options.relative_tolerance * extent, 0x1p-1074, std::numeric_limits<double>::max());
}

Accuracy accuracy_of(const MeshData& mesh, const Motion& motion, const Options& options) {
  const Extents extents = corner_extents(mesh, motion, largest_separation(mesh, options));
  Accuracy r;
  r.extent = extents.largest();
  r.tolerance = absolute_tolerance(options, r.extent);
  for (std::size_t a = 0; a < 3; ++a)  // 8u R + 4 eta (docs/theory.md, L5)
    r.error_bound[std::size_t(motion.axes[a])] = 0x1p-50 * extents.largest(int(a)) + 4 * 0x1p-1074;
  return r;
}

void note(const Accuracy& accuracy, Stats& stats) {
  stats.tolerance = accuracy.tolerance, stats.extent = accuracy.extent,
  stats.error_bound = accuracy.error_bound;
}

}  // namespace onset
