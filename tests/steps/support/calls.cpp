#include "tests/steps/support/calls.hpp"

namespace onset::tests {

const char* name(Call call) {
  const char* names[] = {"whole", "line search", "listed", "close pairs", "adapter", "filtered adapter"};
  return names[int(call)];
}

Eigen::MatrixXd end_of(Call call, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1) {
  if (call != Call::line_search) return x_t1;
  const Eigen::MatrixXd dx = x_t1 - x_t0;
  return x_t0 + dx;
}

// Lists that memory cuts off are no answer to go on with.
static Options unlimited(Options options) {
  options.memory_limit = Options().memory_limit;
  return options;
}

LineSearchOptions with_share(const Options& options, double gap_share) {
  LineSearchOptions o = options;
  o.gap_share = gap_share;
  return o;
}

CallStep Calls::search(const Mesh& mesh, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1,
                       const Options& options, double gap_share) const {
  const LineSearchStep r =
      LineSearch(mesh, x_t0, Eigen::MatrixXd(x_t1 - x_t0), with_share(options, gap_share)).largest_step();
  return {r, r.gap_share, r.stats.tolerance, true, {}, INFINITY};
}

CallStep Calls::ask(Call call, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1,
                    const Options& options, double d_hat, double gap_share) const {
  switch (call) {
    case Call::whole:
      return {compute_collision_free_stepsize(mesh_, x_t0, x_t1, options), 0, 0, true, {}, INFINITY};
    case Call::line_search:
      return search(mesh_, x_t0, x_t1, options, gap_share);
    case Call::listed: {
      const Candidates list = compute_candidates(mesh_, x_t0, x_t1, unlimited(options));
      const StepResult r = compute_collision_free_stepsize(mesh_, list, x_t0, x_t1, options, gap_share);
      return {r, gap_share, r.stats.tolerance, true, list, INFINITY};
    }
    case Call::close: {
      const ClosePairs list = close_pairs(mesh_, x_t0, d_hat, unlimited(options));
      return {compute_cfl_stepsize(mesh_, x_t0, x_t1, list, options, gap_share),
              gap_share,
              gap_share * d_hat,
              true,
              {},
              d_hat};
    }
    case Call::adapter:
    case Call::filtered: {
      CallStep step =
          search(mesh(call), x_t0, x_t1, options, gap_share);  // for what the adapter does not say
      ipc::TightInclusionCCD ccd;
      ccd.tolerance = options.tolerance.value_or(ccd.tolerance), ccd.max_iterations = options.max_checks;
      ccd.conservative_rescaling = 1 - gap_share;
      step.gap_share = 1 - ccd.conservative_rescaling, step.reach = ccd.tolerance, step.says_outcome = false;
      const double d = options.min_separation;
      if (call == Call::filtered) step.only = compute_candidates(mesh(call), x_t0, x_t1, unlimited(options));
      step.result.step = ipc::compute_collision_free_stepsize(call == Call::filtered ? filtered_ : adapter_,
                                                              x_t0, x_t1, d, nullptr, ccd);
      return step;
    }
  }
  return {};
}

}  // namespace onset::tests
