// How far calls overrun their budgets, on triangles that all go through one place: every box overlaps nearly
// every other, so that there are tens of millions of candidates and millions of contacts.
//   onset_budget_overrun [triangles [only calls whose name begins so]]
// Each call with each broad phase gets 1 ms to 1 s, of time_limit and until progress cancels it, with one and
// with two threads; and with the tree a memory limit.
//
// What it did after its end is CPU time of the process, for each thread that it may use, since progress was
// told for the last time before: 10 ms too much, and not more on a machine that others use. Wall time stands
// beside it. "silence" is the longest CPU time of a thread between two reports of progress. Exits with 1
// where either is more than 50 ms, as onset/options.hpp promises, or memory is.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <onset/onset.hpp>
#include <string>
#include <vector>

#include "measure/system.hpp"
#include "measure/timing.hpp"

namespace {

constexpr double kMostOverrun = 0.05;  // s a thread
constexpr double kLimits[] = {1e-3, 1e-2, 1e-1, 1};
constexpr std::int64_t kMemory = 64 << 20;
constexpr double kMostMemory = 2.25;  // of kMemory: as much again while rows are put in order

// Numbers in [0, 1), the same on every platform.
class Random {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return double(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 1;
};

struct Spot {
  Eigen::MatrixXd x_t0, x_t1, dx;
  Eigen::MatrixXi faces;
  onset::Mesh mesh;
  Eigen::MatrixXd stack_t0, stack_t1;  // the same triangles in parallel planes, free of contact

  explicit Spot(int triangles) : x_t0(3 * triangles, 3), faces(triangles, 3) {
    Random random;
    for (Eigen::Index f = 0; f < triangles; ++f)
      for (Eigen::Index k = 0; k < 3; ++k) {
        faces(f, k) = int(3 * f + k);
        for (Eigen::Index a = 0; a < 3; ++a) x_t0(3 * f + k, a) = (0.2 + 0.8 * random()) * (k == a ? -1 : 1);
      }
    x_t1 = x_t0;
    for (Eigen::Index i = 0; i < x_t1.size(); ++i) x_t1.data()[i] += 0.1 * (random() - 0.5);
    dx = x_t1 - x_t0;
    mesh = onset::Mesh(x_t0.rows(), faces);
    stack_t0 = x_t0;
    for (Eigen::Index v = 0; v < stack_t0.rows(); ++v)  // tilted, so that all boxes overlap
      stack_t0(v, 2) = stack_t0(v, 0) + 0.1 * double(v / 3) / triangles;
    stack_t1 = stack_t0.array() + 0.1;
  }
};

// What one call did, by what progress was told.
class Meter {
 public:
  // Cancels once `cancel_after` seconds are over.
  void start(double cancel_after) {
    cancel_after_ = cancel_after;
    watch_ = app::Stopwatch();
    told_ = end_ = {};
    silence_ = 0;
    running_ = true;
  }
  bool tell() {
    if (!running_) return true;
    const app::Seconds now = watch_.elapsed();
    silence_ = std::max(silence_, now.cpu - told_.cpu);
    told_ = now;
    return now.wall < cancel_after_;
  }
  void stop() {
    if (!running_) return;
    running_ = false;
    end_ = watch_.elapsed();
  }
  app::Seconds end() const { return end_; }
  double since_told() const { return end_.cpu - told_.cpu; }
  double silence() const { return std::max(silence_, since_told()); }

 private:
  double cancel_after_ = 0, silence_ = 0;
  bool running_ = false;
  app::Stopwatch watch_;
  app::Seconds told_, end_;
};

// What some calls are given, made without a limit.
struct Given {
  onset::Candidates candidates;
  onset::ClosePairs close;
  onset::LineSearch search[2];  // of one thread, of two
};

constexpr double kDHat = 0.01;

struct Call {
  const char* name;
  bool by_broad_phase;
  bool keeps_pairs;
  bool is_limited;  // else it takes its time limit from an object made before
  std::function<onset::Outcome(const Spot&, const Given&, const onset::Options&, Meter&)> run;
};

onset::LineSearchOptions with_d_hat(const onset::Options& o) {
  onset::LineSearchOptions r = o;
  r.d_hat = kDHat;
  return r;
}

template <class Result>
onset::Outcome outcome(Meter& meter, const Result& result) {
  meter.stop();
  return result.outcome;
}

const std::vector<Call>& calls() {
  using onset::Options;
  static const std::vector<Call> all{
      {"compute_collision_free_stepsize", true, false, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         return outcome(m, onset::compute_collision_free_stepsize(s.mesh, s.x_t0, s.x_t1, o));
       }},
      {"is_step_collision_free", true, false, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         onset::is_step_collision_free(s.mesh, s.stack_t0, s.stack_t1, o);
         m.stop();
         return onset::Outcome::free;  // or not known
       }},
      {"construct_active_set", true, true, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         return outcome(m, onset::construct_active_set(s.mesh, s.x_t0, s.x_t1, o));
       }},
      {"compute_candidates", true, true, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         return outcome(m, onset::compute_candidates(s.mesh, s.x_t0, s.x_t1, o));
       }},
      {"count_candidates", true, false, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         return outcome(m, onset::count_candidates(s.mesh, s.x_t0, s.x_t1, o));
       }},
      {"close_pairs", true, true, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         return outcome(m, onset::close_pairs(s.mesh, s.x_t0, kDHat, o));
       }},
      {"check", true, true, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         return outcome(m, onset::check(s.mesh, s.x_t0, o));
       }},
      {"intersections", true, true, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         return outcome(m, onset::intersections(s.mesh, s.x_t0, o));
       }},
      {"LineSearch", true, true, true,
       [](const Spot& s, const Given&, const Options& o, Meter& m) {
         const onset::LineSearch search(s.mesh, s.x_t0, s.dx, with_d_hat(o));
         m.stop();
         return search.largest_step(0).outcome;
       }},
      {"LineSearch::largest_step", false, false, false,
       [](const Spot&, const Given& g, const Options& o, Meter& m) {
         return outcome(m, g.search[o.threads - 1].largest_step());
       }},
      {"LineSearch::close_pairs", false, false, false,
       [](const Spot&, const Given& g, const Options& o, Meter& m) {
         return outcome(m, g.search[o.threads - 1].close_pairs(0.5));
       }},
      {"step of listed candidates", false, false, true,
       [](const Spot& s, const Given& g, const Options& o, Meter& m) {
         return outcome(m, onset::compute_collision_free_stepsize(s.mesh, g.candidates, s.x_t0, s.x_t1, o));
       }},
      {"compute_cfl_stepsize", false, false, true,
       [](const Spot& s, const Given& g, const Options& o, Meter& m) {
         return outcome(m, onset::compute_cfl_stepsize(s.mesh, s.x_t0, s.x_t1, g.close, o));
       }},
  };
  return all;
}

struct Method {
  const char* name;
  onset::BroadPhaseMethod method;
};
constexpr Method kMethods[] = {{"bvh", onset::BroadPhaseMethod::bvh},
                               {"hash", onset::BroadPhaseMethod::hash},
                               {"brute", onset::BroadPhaseMethod::brute}};

class Bench {
 public:
  Bench(int triangles, const std::string& only) : spot_(triangles), only_(only) {}

  int run() {
    std::printf("%d triangles in one place, %s\n", int(spot_.faces.rows()), app::machine().c_str());
    std::printf("%-34s %-6s %-7s %7s %7s  %-13s %9s %9s %10s %7s\n", "call", "by", "ended", "threads",
                "limit", "outcome", "wall over", "CPU over", "silence", "within");
    for (const Call& call : calls()) {
      if (std::string(call.name).rfind(only_, 0) != 0) continue;
      for (const Method& method : kMethods) {
        if (!call.by_broad_phase && method.method != onset::BroadPhaseMethod::bvh) continue;
        for (const int threads : {1, 2})
          for (const double limit : kLimits) {
            if (call.is_limited) time(call, method, threads, limit, false);
            time(call, method, threads, limit, true);
          }
      }
      if (call.keeps_pairs) memory(call);
    }
    std::printf("%d of %d beyond the promise; the longest: %.1f ms over, %.1f ms of silence\n", beyond_,
                runs_, 1e3 * over_, 1e3 * silence_);
    return beyond_ == 0 ? 0 : 1;
  }

 private:
  onset::Options options(const Method& method, int threads) {
    onset::Options o;
    o.broad_phase = method.method;
    o.threads = threads;
    o.progress = [this](double) { return meter_.tell(); };
    return o;
  }

  // The memory that the last call left is first given back, so that each makes its own tree.
  void time(const Call& call, const Method& method, int threads, double limit, bool cancels) {
    give(call);
    spot_.mesh.release_memory();
    onset::Options o = options(method, threads);
    if (!cancels) o.time_limit = limit;
    meter_.start(cancels ? limit : HUGE_VAL);
    const onset::Outcome ended = call.run(spot_, given_, o, meter_);
    const bool is_over = meter_.end().wall >= limit;
    const double over = is_over ? meter_.since_told() / threads : 0, silence = meter_.silence() / threads;
    const bool within = over <= kMostOverrun && silence <= kMostOverrun;
    ++runs_, beyond_ += !within;
    over_ = std::max(over_, over), silence_ = std::max(silence_, silence);
    std::printf("%-34s %-6s %-7s %7d %4g ms  %-13s %6.1f ms %6.1f ms %7.1f ms %7s\n", call.name,
                call.by_broad_phase ? method.name : "-", cancels ? "caller" : "time", threads, 1e3 * limit,
                onset::to_string(ended), 1e3 * std::max(0.0, meter_.end().wall - limit), 1e3 * over,
                1e3 * silence, within ? "yes" : "NO");
    std::fflush(stdout);
  }

  // Beside what the call takes without room for any pair.
  void memory(const Call& call) {
    const auto peak = [&](std::int64_t limit, onset::Outcome& ended) {
      onset::Options o = options(kMethods[0], 2);
      o.memory_limit = limit;
      return app::peak_bytes([&] { ended = call.run(spot_, given_, o, meter_); });
    };
    onset::Outcome none, ended;
    const auto least = peak(0, none), most = peak(kMemory, ended);
    if (!least || !most) return;
    const double taken = double(*most - *least), share = taken / double(kMemory);
    const bool within = share <= kMostMemory;
    ++runs_, beyond_ += !within;
    std::printf("%-34s %-6s %-7s %7d %4lld MB  %-13s takes %.0f MB more than for none %14s\n", call.name,
                kMethods[0].name, "memory", 2, static_cast<long long>(kMemory >> 20), onset::to_string(ended),
                taken / (1 << 20), within ? "yes" : "NO");
    std::fflush(stdout);
  }

  // Makes what the call is given, once.
  void give(const Call& call) {
    const std::string name = call.name;
    onset::Options o = options(kMethods[0], 2);
    if (name == "step of listed candidates" && given_.candidates.counts.total() == 0)
      given_.candidates = onset::compute_candidates(spot_.mesh, spot_.x_t0, spot_.x_t1, o);
    if (name == "compute_cfl_stepsize" && given_.close.size() == 0)
      given_.close = onset::close_pairs(spot_.mesh, spot_.x_t0, kDHat / 10, o);
    if (name.rfind("LineSearch::", 0) == 0 && !made_searches_)
      for (o.threads = 1, made_searches_ = true; o.threads <= 2; ++o.threads)
        given_.search[o.threads - 1] = onset::LineSearch(spot_.mesh, spot_.x_t0, spot_.dx, with_d_hat(o));
  }

  Spot spot_;
  const std::string only_;
  Meter meter_;
  Given given_;
  bool made_searches_ = false;
  int runs_ = 0, beyond_ = 0;
  double over_ = 0, silence_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const int triangles = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5000;
  return Bench(triangles, argc > 2 ? argv[2] : "").run();
}
