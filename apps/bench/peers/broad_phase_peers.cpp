// The tree against the hash, and against the broad phases of FCL and Embree, where these are found: from
// positions to pairs, one thread, in turn.
//
//   onset_broad_phase_peers A B [REPEATS]
//
// Prints CPU times, the ratio of each round's times, and the numbers of pairs. The hash must find as many as
// the tree, the others as many or a few less: exit status 1 where they do not.
#include <tbb/global_control.h>

#include <cstdio>
#include <cstdlib>

#include "bench/peers/peer.hpp"
#include "bench/peers/stored_pairs.hpp"
#include "files/error.hpp"
#include "files/scene/scene.hpp"
#include "measure/timing.hpp"

namespace {

struct Contestant {
  app::Peer peer;
  bool ours;
  std::vector<double> seconds, ratio;
  onset::PairCounts counts;
};

std::vector<Contestant> contestants(const app::Scene& scene) {
  std::vector<Contestant> all;
  for (const auto& [name, method] : {std::pair{"onset", onset::BroadPhaseMethod::bvh},
                                     std::pair{"onset, hash", onset::BroadPhaseMethod::hash}}) {
    const auto ours = std::make_shared<app::StoredPairs>(scene.mesh, method);
    all.push_back({{name, [ours](const auto& x_t0, const auto& x_t1) { return ours->find(x_t0, x_t1, 1); }},
                   true,
                   {},
                   {},
                   {}});
  }
#ifdef ONSET_BENCH_FCL
  all.push_back({app::fcl_peer(scene.mesh, app::Tree::built), false, {}, {}, {}});
  all.push_back({app::fcl_peer(scene.mesh, app::Tree::updated), false, {}, {}, {}});
#endif
#ifdef ONSET_BENCH_EMBREE
  all.push_back({app::embree_peer(scene.mesh), false, {}, {}, {}});
#endif
  return all;
}

// One round: everybody once, in turn.
void run_round(std::vector<Contestant>& all, const app::Scene& scene, bool warm_up) {
  for (Contestant& c : all) {
    const app::Stopwatch watch;
    c.counts = c.peer.find(scene.x_t0, scene.x_t1);
    if (!warm_up) c.seconds.push_back(watch.elapsed().cpu);
  }
  if (warm_up) return;
  for (Contestant& c : all) c.ratio.push_back(c.seconds.back() / all[0].seconds.back());
}

bool same(const onset::PairCounts& a, const onset::PairCounts& b) {
  return a.vertex_face == b.vertex_face && a.edge_edge == b.edge_edge;
}
// Our boxes reach a little farther, for what storing positions may change: one pair in a hundred thousand at
// most.
bool agree(const onset::PairCounts& theirs, const onset::PairCounts& ours) {
  const auto few = [](std::int64_t n, std::int64_t of) { return n >= 0 && n <= of / 100000; };
  return few(ours.vertex_face - theirs.vertex_face, ours.vertex_face) &&
         few(ours.edge_edge - theirs.edge_edge, ours.edge_edge);
}

bool print(const std::vector<Contestant>& all) {
  bool all_agree = true;
  std::printf("%-31s %26s   %22s   %9s %9s\n", "", "CPU ms [least, most]", "times onset [l, m]", "vf", "ee");
  for (const Contestant& c : all) {
    const app::Spread s = app::spread(c.seconds), r = app::spread(c.ratio);
    std::printf("%-31s %8.1f [%6.1f, %6.1f]   %6.2f [%5.2f, %5.2f]   %9lld %9lld\n", c.peer.name.c_str(),
                1e3 * s.median, 1e3 * s.least, 1e3 * s.most, r.median, r.least, r.most,
                static_cast<long long>(c.counts.vertex_face), static_cast<long long>(c.counts.edge_edge));
    all_agree = all_agree && (c.ours ? same : agree)(c.counts, all[0].counts);
  }
  return all_agree;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3 || argc > 4) throw app::UsageError("usage: onset_broad_phase_peers A B [REPEATS]");
  const int repeats = argc == 4 ? std::atoi(argv[3]) : 7;
  const app::Scene scene = app::read_scene(argv[1], argv[2]);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism,
                                       1);  // Embree has no arena
  std::vector<Contestant> all = contestants(scene);
  for (int i = 0; i <= repeats; ++i) run_round(all, scene, i == 0);
  if (print(all)) return 0;
  std::printf("the numbers of pairs differ\n");
  return 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "onset_broad_phase_peers: %s\n", e.what());
  return 2;
}
