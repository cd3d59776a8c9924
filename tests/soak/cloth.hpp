// Two sheets that are crumpled and unfolded, without end, by a motion that is made up: what a simulator asks
// of the library in one run, in small.
#pragma once

#include <array>
#include <functional>
#include <onset/onset.hpp>
#include <vector>

#include "tests/scenes/random.hpp"
#include "tests/src/support/answer.hpp"

namespace onset::tests {

// The calls that are timed.
enum class Asked {
  step,
  line_search,
  listed_step,
  cfl_step,
  close_pairs,
  active_set,
  free,
  intersections,
  check
};
constexpr int kAsked = 9;
const char* name(Asked asked);

// One life of a mesh: made, asked `kLife` steps long, and gone. All of it follows from the seed.
class Cloth {
 public:
  static constexpr int kLife = 100;
  // Told what a call took, in seconds of all threads.
  using Timed = std::function<void(Asked, double)>;

  Cloth(std::uint64_t seed, const Timed& timed);
  // The next step. `answer` gets the bytes of all that the library says.
  void step(int threads, Answer& answer);

  struct Tally {
    std::int64_t steps = 0, moved = 0, limited = 0, close_pairs = 0, contacts = 0, intersecting = 0;
  };
  const Tally& tally() const { return tally_; }
  // Edges and faces that have a common point, by rational arithmetic of every pair: nothing of the library.
  int exact_intersections() const;

 private:
  Eigen::MatrixXd direction(const ClosePairs& close);
  double safe_step(const Eigen::MatrixXd& x_t1, const Eigen::MatrixXd& dx, const ClosePairs& close,
                   const Options& options, Answer& answer);
  void look(const Eigen::MatrixXd& x_t1, const Options& options, Answer& answer);
  void change_rules(const ClosePairs& close);
  template <class F>
  auto ask(Asked asked, const F& f);

  scenes::Random random_;
  const Timed& timed_;
  Eigen::MatrixXd rest_, x_;
  Eigen::MatrixXi faces_;
  Mesh mesh_;
  int at_ = 0;
  Tally tally_;
};

}  // namespace onset::tests
