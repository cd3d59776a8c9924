#include "simulation/search.hpp"

#include <stdexcept>
#include <string>

namespace simulation {
namespace {

onset::LineSearchOptions with_d_hat(const onset::Options& options, double d_hat) {
  onset::LineSearchOptions all = options;
  all.d_hat = d_hat;
  return all;
}

}  // namespace

FilteredDirection::FilteredDirection(const onset::Mesh& mesh, const onset::Positions& x,
                                     const onset::Positions& dx, double d_hat,
                                     const onset::Options& options) {
  const Timer timer;
  search_ = onset::LineSearch(mesh, x, dx, with_d_hat(options, d_hat));
  const onset::StepResult limit = search_.largest_step();
  if (limit.outcome != onset::Outcome::free && limit.outcome != onset::Outcome::contact)
    throw std::runtime_error(std::string("the line search ended with ") + onset::to_string(limit.outcome));
  first_.limit = first_.step = limit.step;
  first_.contact = limit.outcome == onset::Outcome::contact;
  first_.close = search_.close_pairs(limit.step);
  first_.seconds_collision = timer.seconds();
}

}  // namespace simulation
