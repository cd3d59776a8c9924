// Whatever floating-point environment the host has set, in the calling thread and in TBB's workers, answers
// are those of a clean process, and the host finds its environment and flags as they were.
#if defined(__SSE2__)
#include <immintrin.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <onset/onset.hpp>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/data.hpp"
#include "tests/scenes/frame_file.hpp"
#include "tests/src/support/every_call.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

constexpr unsigned kClean = 0x1f80;
struct Mode {
  const char* name;
  unsigned mxcsr;
};
constexpr Mode kModes[] = {{"downward", 0x3f80},
                           {"upward", 0x5f80},
                           {"toward zero", 0x7f80},
                           {"subnormal numbers are zero", 0x1f80 | 0x8040},
                           {"every trap on", 0x0000},
                           {"flags raised", 0x1f80 | 0x3f},
                           {"downward, subnormal numbers are zero, every trap on", 0xa040}};
constexpr int kNumModes = int(std::size(kModes));

// While it lives: in this thread, and in as many workers as can be had.
struct Host {
  explicit Host(unsigned mxcsr) : mxcsr_(mxcsr) { set(mxcsr); }
  ~Host() { set(kClean); }
  bool untouched() const { return _mm_getcsr() == mxcsr_; }
  static void set(unsigned mxcsr) {
    tbb::parallel_for(0, 2000, [&](int) { _mm_setcsr(mxcsr); });
    _mm_setcsr(mxcsr);
  }
  unsigned mxcsr_;
};

// Whether the call, on a new mesh, gives this answer, and leaves the environment alone.
void check_in(const Mode& mode, const Call& call, const Subject& subject, const Options& options,
              const Answer& clean) {
  Answer found;
  bool untouched = false;
  {
    const Host host(mode.mxcsr);
    found = call(subject.mesh(), subject, options);
    untouched = host.untouched();
  }
  CAPTURE(subject.name, call.name, options.threads, mode.name);
  CHECK(untouched);
  CHECK(found == clean);
}

}  // namespace

TEST_CASE("no floating-point environment of the host changes a byte of any call", "[determinism][tbb]") {
  std::vector<Subject> subjects = small_subjects();
  if (fuzz(4) >= 4)
    for (const NamedScene& named : some_scenes()) subjects.emplace_back(named.name, named.scene);
  for (const Subject& subject : subjects)
    for (const Call& call : every_call()) {
      const Answer clean = call(subject.mesh(), subject, {});
      for (const int threads : {0, 1, 2})
        for (const Mode& mode : kModes) {
          Options options;
          options.threads = threads;
          check_in(mode, call, subject, options, clean);
        }
    }
}

TEST_CASE("a callback's floating-point environment ends with it", "[determinism][tbb]") {
  const std::vector<Subject> subjects = small_subjects();
  for (const Call& call : every_call()) {
    if (!call.reports) continue;
    for (const Mode& mode : kModes) {
      const Subject& s = subjects[std::size_t(&mode - kModes) % subjects.size()];
      Options plain, changes;
      changes.progress = [&](double) {
        _mm_setcsr(mode.mxcsr);
        return true;
      };
      CAPTURE(call.name, s.name, mode.name);
      CHECK(call(s.mesh(), s, changes) == call(s.mesh(), s, plain));
      CHECK((_mm_getcsr() & ~0x3fu) == kClean);  // but for flags of this test's own
    }
  }
}

TEST_CASE("a subnormal d-hat is one for hosts that have no subnormal numbers", "[determinism][tbb]") {
  const Subject s = std::move(small_subjects().front());
  const Mesh mesh = s.mesh();
  LineSearchOptions options;
  options.d_hat = 0x1p-1040;
  const auto clean = LineSearch(mesh, s.scene.x_t0, s.dx, options).close_pairs(0);
  for (const Mode& mode : kModes) {
    LineSearch search;
    std::size_t inside = clean.size() + 1;
    ActiveSet set;
    set.contacts.resize(2);
    set.contacts[0].toi = 0x1p-1030, set.contacts[1].toi = 0x1p-1040;
    const Contact* earliest = nullptr;
    {
      const Host host(mode.mxcsr);
      search = LineSearch(mesh, s.scene.x_t0, s.dx, options);
      inside = search.close_pairs(0).size();
      earliest = set.earliest();
    }
    CAPTURE(mode.name);
    CHECK(inside == clean.size());
    CHECK(search.close_pairs(0).size() == clean.size());
    CHECK(earliest == &set.contacts[1]);
  }
}

// In a run of the tests each call has one step, mode and number of threads; ONSET_FUZZ=3 asks for all of
// them.
TEST_CASE("recorded steps mind no floating-point environment either", "[determinism][tbb][data]") {
  const std::string folder = scenes::data_folder("recorded steps mind no floating-point environment either");
  if (folder.empty()) return;
  const bool all = fuzz(1) >= 3;
  int asked = 0, turn = 0;
  const auto steps = scenes::recorded_steps();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const scenes::Recording recording = scenes::read_recording(folder, steps[k]);
    const Subject subject(steps[k].name, {recording.t0.x, recording.t1.x, recording.t0.faces}, {}, 1e-4);
    for (std::size_t c = 0; c < every_call().size(); ++c) {
      if (!all && c % steps.size() != k) continue;
      const Call& call = every_call()[c];
      const Answer clean = call(subject.mesh(), subject, {});
      ++turn;
      for (int i = 0; i < 3 * kNumModes; ++i) {
        if (!all && i != turn % (3 * kNumModes)) continue;
        Options options;
        options.threads = i % 3;
        check_in(kModes[i % kNumModes], call, subject, options, clean);
        ++asked;
      }
    }
  }
  std::printf("%d calls on recorded steps, each in another environment\n", asked);
}

// An arena keeps the environment of whoever made it, and so do its workers.
TEST_CASE("arenas that were made in one environment are used in another", "[determinism][tbb]") {
  const Subject subject = std::move(small_subjects().back());
  std::vector<Answer> clean;
  for (const Call& call : every_call()) clean.push_back(call(subject.mesh(), subject, {}));
  int threads = 20;  // of which no other test makes arenas
  for (const Mode& made_in : kModes) {
    Options options;
    options.threads = ++threads;
    tbb::task_arena own(4);
    {
      const Host host(made_in.mxcsr);
      const Mesh mesh = subject.mesh();
      own.execute([&] { every_call().front()(mesh, subject, {}); });
      every_call().front()(mesh, subject, options);
    }
    for (const Mode& mode : kModes)
      for (std::size_t i = 0; i < every_call().size(); ++i) {
        CAPTURE(made_in.name);
        check_in(mode, every_call()[i], subject, options, clean[i]);
        Answer in_own;
        {
          const Host host(mode.mxcsr);
          const Mesh mesh = subject.mesh();
          own.execute([&] { in_own = every_call()[i](mesh, subject, {}); });
        }
        CHECK(in_own == clean[i]);
      }
  }
}

TEST_CASE("single queries mind no floating-point environment either", "[determinism][tbb]") {
  VertexFaceQuery query;
  query.t0 = {{{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  query.t1 = {{{0.25, 0.25, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  VertexFaceQuery tiny = query;
  for (auto* end : {&tiny.t0, &tiny.t1})
    for (Point& p : *end)
      for (double& x : p) x *= 0x1p-1060;
  for (const VertexFaceQuery& q : {query, tiny}) {
    const QueryResult clean = vertex_face_ccd(q);
    CHECK((clean.outcome == PairOutcome::contact && clean.toi <= 0.5));
    for (const Mode& mode : kModes) {
      CAPTURE(mode.name);
      QueryResult found;
      bool untouched = false;
      {
        const Host host(mode.mxcsr);
        found = vertex_face_ccd(q);
        untouched = host.untouched();
      }
      CHECK(untouched);
      CHECK(Answer().add(found) == Answer().add(clean));
    }
  }
}

TEST_CASE("a host finds its environment again where its own work throws", "[determinism][tbb]") {
  const Host host(0x2000);  // downward, every trap on
  double third = 0;
  bool threw = false;
  try {
    in_default_float_environment([&] {
      third = std::sqrt(1.0 / 9);
      throw std::runtime_error("enough");
    });
  } catch (const std::runtime_error&) {
    threw = true;
  }
  const bool untouched = host.untouched();
  Host::set(kClean);
  CHECK((threw && untouched && third == 1.0 / 3));
}

// A comparison with NaN is an invalid operation.
TEST_CASE("what is not a number is refused, not trapped", "[determinism][tbb]") {
  const Subject s = std::move(small_subjects().front());
  const Mesh mesh = s.mesh();
  const std::vector<double> nans(std::size_t(mesh.num_vertices()), NAN);
  Eigen::MatrixXd unusable = s.scene.x_t1;
  unusable(1, 1) = NAN;
  Mesh changed = mesh;
  CollisionRules thick;
  thick.thickness = nans;
  ClosePairs close = s.close;
  close.d_hat = NAN;
  const LineSearch search(mesh, s.scene.x_t0, s.dx);
  LineSearchOptions share, reach;
  share.gap_share = reach.d_hat = NAN;
  const auto with = [&](auto change) {
    Options o;
    change(o);
    return [&, o] { compute_collision_free_stepsize(mesh, s.scene.x_t0, s.scene.x_t1, o); };
  };
  const std::vector<std::pair<const char*, std::function<void()>>> refused{
      {"tolerance", with([](Options& o) { o.tolerance = NAN; })},
      {"relative_tolerance", with([](Options& o) { o.relative_tolerance = NAN; })},
      {"min_separation", with([](Options& o) { o.min_separation = NAN; })},
      {"window", with([](Options& o) { o.window = NAN; })},
      {"time_limit", with([](Options& o) { o.time_limit = NAN; })},
      {"d_hat of close pairs", [&] { close_pairs(mesh, s.scene.x_t0, NAN); }},
      {"d_hat of a line search", [&] { LineSearch(mesh, s.scene.x_t0, s.dx, reach); }},
      {"gap_share of a line search", [&] { LineSearch(mesh, s.scene.x_t0, s.dx, share); }},
      {"upper", [&] { search.largest_step(NAN); }},
      {"step", [&] { search.close_pairs(NAN); }},
      {"gap_share of candidates",
       [&] { compute_collision_free_stepsize(mesh, s.candidates, s.scene.x_t0, s.scene.x_t1, {}, NAN); }},
      {"gap_share of close pairs",
       [&] { compute_cfl_stepsize(mesh, s.scene.x_t0, s.scene.x_t1, s.close, {}, NAN); }},
      {"d_hat of the close pairs", [&] { safe_distances(mesh, s.scene.x_t0, close); }},
      {"eta", [&] { assemble_constraints(s.set, NAN); }},
      {"thickness", [&] { changed.set_rules(thick); }},
      {"a row of copies", [&] { duplicate_vertices(unusable); }}};
  for (const auto& [name, ask] : refused) {
    CAPTURE(name);
    bool threw = false, untouched = false;
    {
      const Host host(0x0000);
      try {
        ask();
      } catch (const std::invalid_argument&) {
        threw = true;
      }
      untouched = host.untouched();
    }
    CHECK((threw && untouched));
  }
  Outcome outcomes[4];
  double step = -1;
  {
    const Host host(0x0000);
    outcomes[0] = compute_collision_free_stepsize(mesh, s.scene.x_t0, unusable).outcome;
    outcomes[1] = construct_active_set(mesh, s.scene.x_t0, unusable).outcome;
    outcomes[2] = close_pairs(mesh, unusable, s.d_hat).outcome;
    outcomes[3] = check(mesh, unusable).outcome;
    step = safe_step(nans, s.dx);
  }
  for (const Outcome outcome : outcomes) CHECK(outcome == Outcome::non_finite);
  CHECK(step == 0);
}
#endif
