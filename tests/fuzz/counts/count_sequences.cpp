// How often a sequence of calls, as a Newton solver makes them, answers otherwise with another kernel, with
// two threads, on a fresh mesh, or without the pairs that are held from call to call:
//   onset_count_sequences [SEQUENCES] [SEED]        default: 1,000 from seed 1
// Every answer must be the same bytes, and an active set of the whole step must look at the same number of
// candidates. The exit status is 1 where anything differs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "tests/fuzz/digest.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/scenes/random.hpp"

using namespace onset;
using namespace onset::fuzz;
using scenes::integer;
using scenes::Random;

namespace {

constexpr int kTold = 10;

struct Counts {
  long long sequences = 0, calls = 0, answers = 0, held = 0, contacts = 0, differ = 0;
};

// Sheets, flat on one grid or crumpled, spheres and soups of a few hundred triangles at most.
scenes::Scene random_scene(Random& random) {
  const int n = integer(random, 3, 10), m = integer(random, 3, 10);
  const double gap = scenes::coin(random) ? 0.1 : scenes::power_of_ten(random, -6, 0);
  switch (integer(random, 0, 4)) {
    case 0:
      return scenes::triangle_soup(integer(random, 2, 250), scenes::power_of_ten(random, -1.5, 0),
                                   scenes::power_of_ten(random, -3, 0), random);
    case 1: {  // coordinates that are alike, and boxes that touch
      scenes::Scene sheets =
          scenes::joined(scenes::cloth(n, m), scenes::translated(scenes::cloth(n, m), {0, 0, gap}));
      scenes::displace(sheets, {0, 0, scenes::coin(random) ? 0 : -0.5 * gap});
      return sheets;
    }
    case 2: {
      scenes::Scene sheets =
          scenes::joined(scenes::cloth(n, m), scenes::translated(scenes::cloth(m, n), {0.03, 0.02, gap}));
      scenes::shake(sheets, scenes::power_of_ten(random, -4, -0.5), random);
      std::swap(sheets.x_t0, sheets.x_t1);
      scenes::shake(sheets, scenes::power_of_ten(random, -4, -0.5), random);
      return sheets;
    }
    case 3:
      return scenes::sphere_onto_cube(std::max(2, n / 2), m, gap, scenes::uniform(random, 0, 2 * gap));
    default:
      return scenes::sphere_onto_sphere(std::max(2, n / 2), m, gap, scenes::uniform(random, 0, 2 * gap));
  }
}

// The usual change of a coordinate along an edge.
double usual_edge(const scenes::Scene& scene) {
  std::vector<double> sizes;
  for (Eigen::Index f = 0; f < scene.faces.rows(); ++f)
    sizes.push_back(
        (scene.x_t0.row(scene.faces(f, 0)) - scene.x_t0.row(scene.faces(f, 1))).cwiseAbs().maxCoeff());
  std::nth_element(sizes.begin(), sizes.begin() + std::ptrdiff_t(sizes.size() / 2), sizes.end());
  return sizes[sizes.size() / 2];
}

// One way to ask: with a mesh of its own that lives as long as the sequence, or with a fresh one.
struct Way {
  InstructionSet instruction_set;
  int threads;
  bool holds, fresh;
  Mesh mesh;
};

class Sequence {
 public:
  Sequence(std::uint64_t seed, Counts& counts)
      : random_(seed), counts_(counts), scene_(random_scene(random_)) {
    const double scale = scenes::coin(random_) ? 1 : std::ldexp(1.0, integer(random_, -60, 60));
    scene_.x_t0 *= scale, scene_.x_t1 *= scale;
    edge_ = usual_edge(scene_);
    make_options();
    make_rules();
    const auto sets = tests::kernels();
    for (const InstructionSet set : sets) ways_.push_back({set, 1, true, false, mesh()});
    ways_.push_back({sets.back(), 2, true, false, mesh()});
    ways_.push_back({pick(sets), integer(random_, 1, 2), false, false, mesh()});
    ways_.push_back({pick(sets), integer(random_, 1, 2), scenes::coin(random_), true, Mesh()});
  }

  // Empty, or which way answers otherwise.
  std::string run() {
    const int calls = integer(random_, 4, 9);
    change_ = edge_ * scenes::power_of_ten(random_, -8, -1.5);
    for (int call = 0; call < calls; ++call) {
      if (call > 0) change(call);
      for (int ask = integer(random_, 0, 9) < 7 ? 1 : 2; ask > 0; --ask) {
        const int what = integer(random_, 0, 9);
        const std::string broken = compare(what < 5 ? 0 : what < 8 ? 1 : what - 6);
        if (!broken.empty()) return "call " + std::to_string(call) + ": " + broken;
      }
    }
    return "";
  }

 private:
  template <class T>
  T pick(const std::vector<T>& list) {
    return list[std::size_t(integer(random_, 0, int(list.size()) - 1))];
  }

  void make_options() {
    options_.relative_tolerance = scenes::power_of_ten(random_, -10, -3);
    if (integer(random_, 0, 3) == 0)
      options_.min_separation = edge_ * scenes::power_of_ten(random_, -4, -0.5);
    if (integer(random_, 0, 3) == 0) options_.norm = Norm::maximum;
    if (integer(random_, 0, 3) == 0) options_.exactness = Exactness(integer(random_, 0, 2));
    if (integer(random_, 0, 5) == 0) options_.window = scenes::unit(random_);
    if (integer(random_, 0, 7) == 0) options_.broad_phase = BroadPhaseMethod::hash;
  }
  void make_rules() {
    const std::size_t n = std::size_t(scene_.x_t0.rows());
    rules_ = CollisionRules();
    if (integer(random_, 0, 2) == 0) {  // the first vertices, which is one of the bodies or a part of it
      const std::size_t still = std::size_t(integer(random_, 1, int(n) - 1));
      rules_.static_vertices.assign(n, false);
      std::fill_n(rules_.static_vertices.begin(), still, true);
    }
    if (integer(random_, 0, 5) == 0)
      for (std::size_t v = 0; v < n; ++v) rules_.thickness.push_back(edge_ * 0.01 * integer(random_, 0, 3));
    hold_statics();
  }
  void hold_statics() {
    for (std::size_t v = 0; v < rules_.static_vertices.size(); ++v)
      if (rules_.static_vertices[v]) scene_.x_t1.row(Eigen::Index(v)) = scene_.x_t0.row(Eigen::Index(v));
  }
  Mesh mesh() const {
    Mesh made(int(scene_.x_t0.rows()), edges(scene_.faces), scene_.faces);
    made.set_rules(rules_);
    return made;
  }

  // What happens between two calls: positions change a little, mostly.
  void change(int call) {
    const int what = integer(random_, 0, 23);
    if (what == 0) {
      make_rules();
      for (Way& way : ways_)
        if (!way.fresh) way.mesh.set_rules(rules_);
    } else if (what == 1) {  // the step is made
      std::swap(scene_.x_t0, scene_.x_t1);
    } else if (what == 2) {
      const bool many = options_.min_separation == 0;
      options_.min_separation = many ? edge_ * scenes::power_of_ten(random_, -4, -1) : 0;
    } else if (what == 3) {
      for (Way& way : ways_) way.mesh.release_memory();
    } else if (what == 4) {  // copies go on with what they share
      for (Way& way : ways_) way.mesh = Mesh(way.mesh);
    } else {
      const double by = what == 5 ? edge_ : change_ * std::pow(0.5, call);
      const int moved = integer(random_, 0, 9);  // all, or one in so many
      for (Eigen::Index v = 0; v < scene_.x_t0.rows(); ++v) {
        if (moved > 5 && integer(random_, 0, moved) > 0) continue;
        for (int a = 0; a < 3; ++a) {
          const double d = integer(random_, 0, 3) == 0 ? by : scenes::uniform(random_, -by, by);
          if (moved % 2 == 0) scene_.x_t0(v, a) += d;
          scene_.x_t1(v, a) += d;
        }
      }
    }
    hold_statics();
  }

  std::string ask(int what, const Mesh& mesh, const Options& options, const char*& phase) {
    const Eigen::MatrixXd &x0 = scene_.x_t0, &x1 = scene_.x_t1;
    Digest d;
    if (what == 0) {
      const ActiveSet set = construct_active_set(mesh, x0, x1, options);
      phase = set.stats.broad_phase;
      counts_.contacts += std::int64_t(set.size());
      d.add(set);
      // With a window the boxes are those up to a time that a sample of blocks finds first.
      if (std::isinf(options.window)) d.add(set.stats.candidates);
    } else if (what == 1) {
      const StepResult step = compute_collision_free_stepsize(mesh, x0, x1, options);
      phase = step.stats.broad_phase;
      d.add(step);
    } else if (what == 2) {
      d.add(is_step_collision_free(mesh, x0, x1, options));
    } else {
      d.add(compute_candidates(mesh, x0, x1, options));
    }
    return d.bytes();
  }

  std::string compare(int what) {
    static const char* const names[] = {"active set", "step", "is free", "candidates"};
    std::string first;
    ++counts_.calls;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      Way& way = ways_[i];
      if (way.fresh) way.mesh = mesh();
      Options options = options_;
      options.instruction_set = way.instruction_set, options.threads = way.threads;
      options.hold_candidates = way.holds;
      const char* phase = "";
      std::string bytes;
      try {
        bytes = ask(what, way.mesh, options, phase);
      } catch (const std::exception& e) {
        bytes = std::string("throws ") + e.what();
      }
      ++counts_.answers, counts_.held += std::strcmp(phase, "held") == 0;
      if (i == 0)
        first = bytes;
      else if (bytes != first)
        return std::string(names[what]) + " of way " + std::to_string(i) + ", " + phase + ", " +
               std::to_string(way.threads) + " threads";
    }
    return "";
  }

  Random random_;
  Counts& counts_;
  scenes::Scene scene_;
  double edge_ = 0, change_ = 0;
  Options options_;
  CollisionRules rules_;
  std::vector<Way> ways_;
};

}  // namespace

int main(int argc, char** argv) {
  const long long sequences = argc > 1 ? std::atoll(argv[1]) : 1000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  Counts counts;
  for (; counts.sequences < sequences; ++counts.sequences) {
    const std::uint64_t own = seed * 0x9e3779b97f4a7c15u + std::uint64_t(counts.sequences);
    const std::string broken = Sequence(own, counts).run();
    if (broken.empty()) continue;
    if (++counts.differ <= kTold) std::printf("sequence %lld, %s\n", counts.sequences, broken.c_str());
  }
  std::printf(
      "%lld sequences, %lld questions, %lld answers of %zu kernels, %lld of them by pairs that were held, "
      "%lld contacts: "
      "%lld differ\n",
      counts.sequences, counts.calls, counts.answers, tests::kernels().size(), counts.held, counts.contacts,
      counts.differ);
  return counts.differ > 0;
}
