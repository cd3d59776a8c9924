// Sequences of calls on one mesh: each answer is that of a fresh mesh with another kernel and number of
// threads, to the byte.
#include <cmath>
#include <exception>
#include <stdexcept>

#include "tests/fuzz/digest.hpp"
#include "tests/fuzz/mesh_input.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"

namespace onset::fuzz {

const char* const kTarget = "calls";
const int kInputs = 4000;

namespace {

constexpr int kMostCalls = 24;

// A mesh that has been used, and all that came of it.
class Session {
 public:
  Session(Bytes& bytes, MeshInput input) : bytes_(bytes), input_(std::move(input)), mesh_(input_.mesh()) {
    input_.options.threads = 1;
  }

  // Empty, or the call whose answer is not that of a fresh mesh.
  std::string run() {
    for (int call = 0; call < kMostCalls && bytes_.left() > 0 && broken_.empty(); ++call) {
      int what = 0;
      bytes_.whole(what, 0, 23);
      trail_ += " " + std::to_string(what);
      if (what > 20)
        nudge(), ask(what - 21);  // as a solver asks again
      else if (what < 10)
        ask(what);
      else
        change(what);
    }
    return broken_.empty() ? broken_ : broken_ + "\n  calls:" + trail_ + "\n" + to_text(input_);
  }

 private:
  // f(mesh, options) by the mesh in use and by a fresh one.
  template <class F>
  void compare(const char* name, F&& f) {
    Options options = input_.options;
    options.threads = two_threads_ ? 2 : 1;
    const std::string fresh = answer(f, input_.mesh(), other_way(options));
    const std::string used = answer(f, mesh_, options);
    if (used != fresh) broken_ = std::string("another answer after other calls: ") + name;
  }
  // What may not change an answer, otherwise, in turn.
  Options other_way(Options options) {
    static const std::vector<InstructionSet> sets = tests::kernels();
    ++turn_;
    options.instruction_set = sets[turn_ % sets.size()];
    options.threads = turn_ / sets.size() % 2 == 0 ? 1 : 2;
    options.hold_candidates = false;
    return options;
  }
  template <class F>
  static std::string answer(F&& f, const Mesh& mesh, const Options& options) {
    try {
      return digest(f(mesh, options));
    } catch (const std::invalid_argument& e) {
      return std::string("throws ") + e.what();
    }
  }

  void ask(int what) {
    const Eigen::MatrixXd &x0 = input_.x_t0, &x1 = input_.x_t1;
    switch (what) {
      case 0:
        return compare("step", [&](const Mesh& m, const Options& o) {
          return compute_collision_free_stepsize(m, x0, x1, o);
        });
      case 1:
        return compare("active set",
                       [&](const Mesh& m, const Options& o) { return construct_active_set(m, x0, x1, o); });
      case 2:
        return compare("candidates", [&](const Mesh& m, const Options& o) {
          candidates_ = compute_candidates(m, x0, x1, o);
          return *candidates_;
        });
      case 3:
        return compare("close pairs",
                       [&](const Mesh& m, const Options& o) { return close_pairs(m, x0, input_.d_hat, o); });
      case 4:
        return compare("check", [&](const Mesh& m, const Options& o) { return check(m, x0, o); });
      case 5:
        return compare("intersections",
                       [&](const Mesh& m, const Options& o) { return intersections(m, x0, o); });
      case 6:
        return compare("is free",
                       [&](const Mesh& m, const Options& o) { return is_step_collision_free(m, x0, x1, o); });
      case 7:  // those of an earlier motion, too
        if (!candidates_ || candidates_->outcome != Outcome::free) return;
        return compare("step of candidates", [&](const Mesh& m, const Options& o) {
          return compute_collision_free_stepsize(m, *candidates_, x0, x1, o, input_.gap_share);
        });
      case 8:
        return compare("step of close pairs", [&](const Mesh& m, const Options& o) {
          return compute_cfl_stepsize(m, x0, x1, close_pairs(m, x0, input_.d_hat, o), o, input_.gap_share);
        });
      default:
        return ask_search();
    }
  }

  // A line search made now, by either mesh, or one made before whatever has happened since.
  void ask_search() {
    int which = 0;
    bytes_.whole(which, 0, 7);
    if (which >= 4 || searches_.empty()) return begin_search();
    Search& search = searches_[std::size_t(which) % searches_.size()];
    double upper = 1;
    const double uppers[] = {1, 0.5, 0.125, 0};
    bytes_.one_of(upper, uppers);
    const bool same = digest(search.used.largest_step(upper)) == digest(search.fresh.largest_step(upper)) &&
                      digest(search.used.close_pairs(upper)) == digest(search.fresh.close_pairs(upper));
    if (!same) broken_ = "another answer of a line search that lived through other calls";
  }
  void begin_search() {
    LineSearchOptions o(input_.options);
    o.gap_share = input_.gap_share, o.d_hat = input_.d_hat;
    const Eigen::MatrixXd dx = input_.x_t1 - input_.x_t0;
    try {
      Search search{LineSearch(mesh_, input_.x_t0, dx, o), LineSearch(input_.mesh(), input_.x_t0, dx, o)};
      if (searches_.size() < 3)
        searches_.push_back(std::move(search));
      else
        searches_[1] = std::move(search);
    } catch (const std::invalid_argument&) {
      // The direction of a static vertex may not be 0 where its position is not finite.
    }
  }

  void change(int what) {
    switch (what) {
      case 10:
        mesh_.release_memory();
        return;
      case 11: {  // a copy goes on, with what it shares
        Mesh copy = mesh_;
        if (two_threads_) mesh_.set_rules(input_.rules);
        mesh_ = copy;
        return;
      }
      case 12: {
        Mesh moved = std::move(mesh_);
        if (mesh_.num_vertices() != 0) broken_ = "a mesh that was moved from has vertices";
        mesh_ = std::move(moved);
        return;
      }
      case 13:
        two_threads_ = !two_threads_;
        return;
      case 14: {
        input_.rules = CollisionRules();
        read_rules(bytes_, input_);
        mesh_.set_rules(input_.rules);
        return;
      }
      case 15:  // the step is made, and the next one is the same again
        input_.x_t0.swap(input_.x_t1);
        return hold_statics(input_);
      case 16:
        return move_some();
      case 17: {
        const BroadPhaseMethod methods[] = {BroadPhaseMethod::automatic, BroadPhaseMethod::hash,
                                            BroadPhaseMethod::brute};
        return bytes_.one_of(input_.options.broad_phase, methods);
      }
      case 18: {
        const InstructionSet sets[] = {InstructionSet::automatic, InstructionSet::scalar};
        return bytes_.one_of(input_.options.instruction_set, sets);
      }
      case 19:
        return add_plane();
      default:
        input_.options = Options();
        describe_options(bytes_, input_);
        input_.options.threads = 1;
    }
  }

  // One vertex, static or not, or all of them, to where another coordinate is.
  void move_some() {
    if (input_.vertices == 0) return;
    int v = 0, w = 0, axis = 0;
    bytes_.whole(v, 0, input_.vertices), bytes_.whole(w, 0, input_.vertices - 1), bytes_.whole(axis, 0, 2);
    const double by = input_.x_t0(w, axis);
    for (int i = 0; i < input_.vertices; ++i)
      if (v == i || v == input_.vertices) input_.x_t0(i, axis) += by, input_.x_t1(i, axis) += by;
    hold_statics(input_);
  }

  // Coordinates change a little, all of them or one vertex's, at both ends or at the second.
  void nudge() {
    if (input_.vertices == 0) return;
    int v = 0, binary = 0;
    bool both = false;
    bytes_.whole(v, 0, 2 * input_.vertices), bytes_.whole(binary, -52, -4), bytes_.flag(both);
    for (int i = 0; i < input_.vertices; ++i)
      for (int a = 0; a < 3; ++a) {
        if (v < input_.vertices && v != i) continue;
        const double by = std::ldexp((i + a) % 3 - 1, binary);
        input_.x_t1(i, a) += by * std::fabs(input_.x_t1(i, a));
        if (both) input_.x_t0(i, a) += by * std::fabs(input_.x_t0(i, a));
      }
    hold_statics(input_);
  }

  // A plane at a vertex, or anywhere.
  void add_plane() {
    Plane plane;
    for (double& n : plane.normal) {
      int whole = 0;
      bytes_.whole(whole, -3, 3);
      n = whole;
    }
    if (plane.normal == std::array<double, 3>{0, 0, 0}) bytes_.real(plane.normal[1]);
    int v = 0;
    bytes_.whole(v, 0, input_.vertices);
    if (v < input_.vertices)
      for (int a = 0; a < 3; ++a) plane.offset += plane.normal[std::size_t(a)] * input_.x_t0(v, a);
    else
      bytes_.real(plane.offset);
    const auto& n = plane.normal;
    for (const double x : {n[0], n[1], n[2], plane.offset})
      if (!std::isfinite(x)) return;
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) return;
    if (input_.rules.planes.size() > 3) input_.rules.planes.clear();  // no rule names one
    input_.rules.planes.push_back(plane);
    mesh_.set_rules(input_.rules);
  }

  struct Search {
    LineSearch used, fresh;
  };
  Bytes& bytes_;
  MeshInput input_;
  Mesh mesh_;
  bool two_threads_ = false;
  std::size_t turn_ = 0;
  std::vector<Search> searches_;
  std::optional<Candidates> candidates_;
  std::string broken_, trail_;
};

}  // namespace

std::string run_target(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  try {
    return Session(bytes, read_mesh_input(bytes)).run();
  } catch (const std::exception& e) {
    Bytes again(data, size);
    return std::string("throws ") + e.what() + "\n" + to_text(read_mesh_input(again));
  }
}

std::string make_seed(int, scenes::Random& random) {
  std::string seed = seed_of_scene(random);
  for (int i = scenes::integer(random, 40, 200); i > 0; --i) seed += char(random());
  return seed;
}

}  // namespace onset::fuzz
