#include "src/shared/budget.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace onset {
namespace {

// Progress is reported when a task is done, and otherwise once it was not for so many seconds.
constexpr double kReportEvery = 0.01;

}  // namespace

Budget::Budget(const Options& options)
    : options_(options), watched_(std::isfinite(options.time_limit) || options.progress) {
  report();
}

bool Budget::spent() {
  look();
  return outcome() != Outcome::free;
}

bool Budget::interrupted() {
  look();
  return interrupted_.load(std::memory_order_relaxed);
}

Stop Budget::stop() {
  if (!watched_) return {};
  return {this, [](void* budget) { return static_cast<Budget*>(budget)->spent(); }};
}

Stop Budget::interruption() {
  if (!watched_) return {};
  return {this, [](void* budget) { return static_cast<Budget*>(budget)->interrupted(); }};
}

void Budget::look() {
  if (!watched_ || interrupted_.load(std::memory_order_relaxed)) return;
  const double now = clock_.seconds();
  if (now >= options_.time_limit)
    interrupt(Outcome::out_of_time);
  else if (options_.progress && now - reported_at_.load(std::memory_order_relaxed) >= kReportEvery)
    report();
}

void Budget::look_at_checks() {
  if (checks_ >= options_.check_limit) end(Outcome::out_of_checks);
}

bool Budget::counts_checks() const { return options_.check_limit < std::numeric_limits<std::int64_t>::max(); }

void Budget::begin_traversal(std::size_t blocks) {
  blocks_ = blocks;
  blocks_done_ = 0;
}

void Budget::advance(std::size_t blocks) {
  blocks_done_ += blocks;
  if (options_.progress) report();
}

double Budget::done() const { return blocks_ > 0 ? double(blocks_done_) / double(blocks_) : 0; }

// This is not a mutex: a thread that comes while another reports goes on working.
void Budget::report() {
  if (!options_.progress || interrupted_.load(std::memory_order_relaxed) || reporting_.test_and_set()) return;
  struct Release {
    std::atomic_flag& flag;
    ~Release() { flag.clear(); }
  } release{reporting_};
  bool goes_on = true;
  try {
    call_host([&] { goes_on = options_.progress(done()); });
  } catch (...) {
    abandon();
    throw;
  }
  if (!goes_on) interrupt(Outcome::cancelled);
  reported_at_.store(clock_.seconds(), std::memory_order_relaxed);
}

void Budget::interrupt(Outcome why) {
  end(why);
  interrupted_.store(true, std::memory_order_relaxed);
}

// The first reason to end stands.
void Budget::end(Outcome why) {
  Outcome none = Outcome::free;
  outcome_.compare_exchange_strong(none, why);
}

}  // namespace onset
