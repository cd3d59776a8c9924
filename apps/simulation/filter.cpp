#include "simulation/filter.hpp"

#include <cmath>
#include <onset/truncate_step.hpp>
#include <stdexcept>

namespace simulation {
namespace {

onset::LineSearchOptions line_search_options(const FilterSettings& settings, double d_hat) {
  onset::LineSearchOptions all = settings.options;
  all.gap_share = settings.gap_share;
  all.d_hat = d_hat;
  return all;
}

void check_outcome(onset::Outcome outcome, const char* what) {
  if (outcome != onset::Outcome::free && outcome != onset::Outcome::contact)
    throw std::runtime_error(std::string(what) + " ended with " + onset::to_string(outcome));
}

std::string in_words(const onset::Pair& p) {
  std::string words = onset::to_string(p.kind);
  for (const int v : p.vertices)
    if (v >= 0) words += " " + std::to_string(v);
  return words;
}

}  // namespace

Filter::Filter(const onset::Mesh& mesh, const Vector& rest, const FilterSettings& settings)
    : mesh_(&mesh), settings_(settings) {
  if (settings.server.empty()) return;
  if (!mesh.rules().planes.empty())
    throw std::invalid_argument("--collision-server: the scene has planes, which are not handed over");
  server_ = std::make_shared<CollisionServer>(settings.server, mesh, rest);
}

onset::ClosePairs Filter::close_pairs(const Vector& x, double d_hat) const {
  return onset::close_pairs(*mesh_, x, d_hat, settings_.options);
}

FilteredDirection::FilteredDirection(const Filter& filter, const Vector& x, const Vector& dx, double d_hat)
    : filter_(filter), x_(x), dx_(dx), d_hat_(d_hat) {
  if (!dx.allFinite()) throw std::runtime_error("a direction of Newton's method is not finite");
  if (filter.server_) {
    ask_server();
  } else if (filter.settings_.per_vertex) {
    first_.step = 1;
    cut(first_);
  } else {
    ask_library();
  }
}

void FilteredDirection::ask_library() {
  const Timer timer;
  search_ = onset::LineSearch(*filter_.mesh_, x_, dx_, line_search_options(filter_.settings_, d_hat_));
  const onset::StepResult limit = search_.largest_step();
  check_outcome(limit.outcome, "the line search");
  first_.limit = first_.step = limit.step;
  first_.contact = limit.outcome == onset::Outcome::contact;
  if (limit.step == 0 && limit.limiting) first_.pair = in_words(*limit.limiting);
  first_.close = search_.close_pairs(limit.step);
  first_.seconds_collision = timer.seconds();
}

void FilteredDirection::ask_server() {
  const CollisionServer::Answer answer = filter_.server_->ask(x_, x_ + dx_);
  const Timer timer;
  first_.limit = first_.step = answer.step;
  first_.contact = answer.step < 1;
  first_.pair = answer.pair;
  first_.close = filter_.close_pairs(x_ + answer.step * dx_, d_hat_);
  first_.seconds_server = answer.seconds;
  first_.seconds_collision = answer.seconds + timer.seconds();
}

void FilteredDirection::cut(Search& trial) const {
  const Timer timer;
  onset::TruncateOptions options = filter_.settings_.options;
  options.gap_share = filter_.settings_.gap_share;
  const Vector end = x_ + trial.step * dx_;
  onset::TruncatedStep found = onset::truncate_step(*filter_.mesh_, x_, end, options);
  // A pair whose vertices have to stay holds up no other one.
  if (found.outcome != onset::Outcome::initial_contact && found.outcome != onset::Outcome::below_rounding)
    check_outcome(found.outcome, "the step for each vertex");
  if (trial.step == 1) {
    trial.limit = found.kept;
    trial.contact = found.outcome != onset::Outcome::free;
    if (found.kept == 0 && found.limiting) trial.pair = in_words(*found.limiting);
  }
  trial.cut = std::move(found.positions);
  trial.close = filter_.close_pairs(Eigen::Map<const Vector>(trial.cut.data(), x_.size()), d_hat_);
  trial.seconds_collision += timer.seconds();
}

void FilteredDirection::shorten(Search& trial) const {
  trial.step /= 2;
  if (filter_.settings_.per_vertex && !filter_.server_) {
    cut(trial);
    return;
  }
  const Timer timer;
  trial.close =
      filter_.server_ ? filter_.close_pairs(x_ + trial.step * dx_, d_hat_) : search_.close_pairs(trial.step);
  trial.seconds_collision += timer.seconds();
}

}  // namespace simulation
