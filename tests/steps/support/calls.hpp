// The calls that give a step, asked in one way.
#pragma once

#include <onset/compat/ipc.hpp>
#include <onset/onset.hpp>
#include <optional>

#include "tests/steps/support/scene_truth.hpp"

namespace onset::tests {

// filtered: the adapter where can_collide is set, so that it goes by candidates.
enum class Call { whole, line_search, listed, close, adapter, filtered };
constexpr Call kCalls[] = {Call::whole, Call::line_search, Call::listed,
                           Call::close, Call::adapter,     Call::filtered};
const char* name(Call call);

// The share of its gap that the calls with a default for it let every pair keep.
constexpr double kGapShare = 0.2;

struct CallStep {
  StepResult result;
  double gap_share = 0;  // the share that every pair that is looked at keeps
  double reach = 0;  // a pair that stays farther beyond its separation than this may keep no more than this
  bool says_outcome = true;        // false: only the step is known
  std::optional<Candidates> only;  // the pairs that are looked at, where these are not all
  double known = INFINITY;         // of pairs that are not near it is only known that their gap is so much
  // Whether no gap that is known is more than twice the rounding: a step of 0 is no surprise.
  bool blind() const { return known <= 2 * result.rounding; }
};

class Calls {
 public:
  explicit Calls(const StepScene& scene)
      : mesh_(scene.mesh()), adapter_(scene.x_t0, scene.edges, scene.faces), filtered_(adapter_) {
    filtered_.can_collide = [](std::size_t, std::size_t) { return true; };
  }
  Mesh& mesh() { return mesh_; }  // to be told more; the adapter's is not
  const Mesh& mesh() const { return mesh_; }
  // That of the call: the adapter tests points against edges and each other as well.
  Mesh mesh(Call call) const { return is_adapter(call) ? adapter_.onset_mesh() : mesh_; }
  static bool is_adapter(Call call) { return call == Call::adapter || call == Call::filtered; }
  // d_hat: of the close pairs, > 0; gap_share: of all calls that have one. The adapter takes a
  // tolerance, a number of checks and a Euclidean separation.
  CallStep ask(Call call, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1, const Options& options,
               double d_hat, double gap_share = kGapShare) const;

 private:
  CallStep search(const Mesh& mesh, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1,
                  const Options& options, double gap_share) const;

  Mesh mesh_;
  ipc::CollisionMesh adapter_, filtered_;
};

// Options of a line search that keeps this share.
LineSearchOptions with_share(const Options& options, double gap_share);

// Where the motion that the call is told of ends: a line search forms its end from a direction.
Eigen::MatrixXd end_of(Call call, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1);

}  // namespace onset::tests
