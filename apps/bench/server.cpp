// Runs one call when told to, so that a script can measure peers in turn with the library.
//
//   onset_bench_server A B
//
// reads two frames, then commands from stdin, one a line, and answers each with one line of JSON:
//   dump FILE                          positions and topology, raw: int64 #V, #E, #F; double x_t0, x_t1 (row
//   after row);
//                                      int32 edges, faces
//   dump-pairs FILE                    pairs whose swept boxes overlap, raw: int64 #vertex-face, #edge-edge;
//   int32 pairs of these active-set THREADS TOLERANCE       the calls, at a relative tolerance step THREADS
//   TOLERANCE pairs THREADS                      positions to stored pairs
//   intersections THREADS END, has-intersections THREADS END    of one frame (END: 0 or 1)
#include <cstdio>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/peers/stored_pairs.hpp"
#include "files/error.hpp"
#include "files/interrupts.hpp"
#include "files/output.hpp"
#include "files/scene/scene.hpp"
#include "measure/timing.hpp"

namespace {

using Json = nlohmann::ordered_json;

template <class T>
void put(app::Output& out, const T* data, std::size_t count) {
  out.write({reinterpret_cast<const char*>(data), count * sizeof(T)});
}

Json dump(const app::Scene& scene, const std::string& path) {
  const onset::Mesh& mesh = scene.mesh;
  app::Output out(path);
  const std::int64_t sizes[3] = {mesh.num_vertices(), mesh.num_edges(), mesh.num_faces()};
  put(out, sizes, 3);
  put(out, scene.x_t0.data(), std::size_t(scene.x_t0.size()));
  put(out, scene.x_t1.data(), std::size_t(scene.x_t1.size()));
  for (std::ptrdiff_t e = 0; e < mesh.num_edges(); ++e) put(out, mesh.edge(e).data(), 2);
  for (std::ptrdiff_t f = 0; f < mesh.num_faces(); ++f) put(out, mesh.face(f).data(), 3);
  out.publish();
  return {{"dumped", path}};
}

Json dump_pairs(const app::Scene& scene, const std::string& path) {
  const onset::Candidates found = onset::compute_candidates(scene.mesh, scene.x_t0, scene.x_t1);
  app::Output out(path);
  const std::int64_t sizes[2] = {found.counts.vertex_face, found.counts.edge_edge};
  put(out, sizes, 2);
  put(out, found.vertex_face.data(), found.vertex_face.size());
  put(out, found.edge_edge.data(), found.edge_edge.size());
  out.publish();
  return {{"dumped", path}};
}

class Server {
 public:
  explicit Server(const app::Scene& scene) : scene_(scene), pairs_(scene.mesh) {}

  Json answer(const std::string& line) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    if (what == "dump" || what == "dump-pairs") {
      std::string path;
      words >> path;
      return what == "dump" ? dump(scene_, path) : dump_pairs(scene_, path);
    }
    int threads = 1;
    onset::Options options;
    words >> threads;
    const bool at_rest = what == "intersections" || what == "has-intersections";
    int end = 0;
    if (at_rest)
      words >> end;
    else if (what != "pairs")
      words >> options.relative_tolerance;
    if (!words || threads < 1 || end < 0 || end > 1) throw app::UsageError("not understood: " + line);
    options.threads = threads;
    return at_rest ? look_at_rest(what, end == 0 ? scene_.x_t0 : scene_.x_t1, options)
                   : measure(what, options);
  }

 private:
  static void add_times(Json& result, const app::Seconds& seconds) {
    result["wall"] = seconds.wall;
    result["cpu"] = seconds.cpu;
  }

  template <class Positions>
  Json look_at_rest(const std::string& what, const Positions& x, const onset::Options& options) {
    Json result;
    const app::Stopwatch watch;
    app::Seconds seconds;
    if (what == "has-intersections") {
      const bool any = onset::has_intersections(scene_.mesh, x, options);
      seconds = watch.elapsed();
      result = {{"any", any}};
    } else {
      const onset::Intersections found = onset::intersections(scene_.mesh, x, options);
      seconds = watch.elapsed();
      for (const auto kind : {onset::IntersectionKind::crossing, onset::IntersectionKind::touching,
                              onset::IntersectionKind::overlapping})
        result[onset::to_string(kind)] = found.count(kind);
    }
    add_times(result, seconds);
    return result;
  }

  Json measure(const std::string& what, const onset::Options& options) {
    Json result;
    const app::Stopwatch watch;
    app::Seconds seconds;
    if (what == "active-set") {
      const onset::ActiveSet set =
          onset::construct_active_set(scene_.mesh, scene_.x_t0, scene_.x_t1, options);
      seconds = watch.elapsed();
      result = {{"contacts", set.size()}, {"candidates", set.stats.candidates.total()}};
    } else if (what == "step") {
      const onset::StepResult step =
          onset::compute_collision_free_stepsize(scene_.mesh, scene_.x_t0, scene_.x_t1, options);
      seconds = watch.elapsed();
      result = {{"step", step.step}, {"outcome", onset::to_string(step.outcome)}};
    } else if (what == "pairs") {
      const onset::PairCounts counts = pairs_.find(scene_.x_t0, scene_.x_t1, options.threads);
      seconds = watch.elapsed();
      result = {{"pairs", counts.total()}};
    } else {
      throw app::UsageError("unknown command: " + what);
    }
    add_times(result, seconds);
    return result;
  }

  const app::Scene& scene_;
  app::StoredPairs pairs_;
};

}  // namespace

int main(int argc, char** argv) try {
  app::prepare_process();
  if (argc != 3) throw app::UsageError("two frames expected");
  const app::Scene scene = app::read_scene(argv[1], argv[2]);
  Server server(scene);
  for (std::string line; std::getline(std::cin, line);) std::cout << server.answer(line) << std::endl;
} catch (const std::exception& e) {
  std::fprintf(stderr, "onset_bench_server: %s\n", e.what());
  return 1;
}
