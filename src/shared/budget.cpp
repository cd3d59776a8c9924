#include "src/shared/budget.hpp"

#include <algorithm>
#include <cmath>

namespace onset {

Budget::Budget(const Options& options) : options_(options) { report(); }

bool Budget::spent() {
  if (outcome() == Outcome::free && std::isfinite(options_.time_limit) &&
      clock_.seconds() >= options_.time_limit)
    end(Outcome::out_of_time);
  return outcome() != Outcome::free;
}

void Budget::look_at_checks() {
  if (checks_ >= options_.check_limit) end(Outcome::out_of_checks);
}

bool Budget::counts_checks() const { return options_.check_limit < std::numeric_limits<std::int64_t>::max(); }

bool Budget::is_watched() const { return std::isfinite(options_.time_limit) || options_.progress; }

void Budget::begin_traversal(std::size_t blocks) {
  blocks_ = blocks;
  blocks_done_ = 0;
}

void Budget::advance(std::size_t blocks) {
  blocks_done_ += blocks;
  if (options_.progress) report();
}

double Budget::done() const { return blocks_ > 0 ? double(blocks_done_) / double(blocks_) : 0; }

// This is not a mutex: a thread that comes while another reports goes on working, and a callback that runs
// parallel work of its own may be given a task of this call, which would wait for itself.
void Budget::report() {
  if (!options_.progress || outcome() != Outcome::free || reporting_.test_and_set()) return;
  struct Release {
    std::atomic_flag& flag;
    ~Release() { flag.clear(); }
  } release{reporting_};
  if (!options_.progress(done())) end(Outcome::cancelled);
}

// The first reason to end stands.
void Budget::end(Outcome why) {
  Outcome none = Outcome::free;
  outcome_.compare_exchange_strong(none, why);
}

}  // namespace onset
