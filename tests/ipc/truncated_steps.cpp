// Steps for each vertex on scenes of a file, for truncate_beside_ipctk.py: any number of #V, #F (int64),
// x_t0, x_t1 (#V x 3 doubles, rows), faces (#F x 3 int32).
//   truncated_steps truncate SCENES ENDS GAP_SHARE   writes the positions that truncate_step gives
//   truncated_steps crossings SCENES ENDS            prints, a line a scene, the pairs that touch exactly on
//   the
//                                                    straight way from x_t0 to ENDS, and those that start
//                                                    touching
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <onset/truncate_step.hpp>

#include "tests/oracle/oracle.hpp"
#include "tests/oracle/quick.hpp"
#include "tests/src/support/mesh_pairs.hpp"

using namespace onset;

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

struct Scene {
  Rows x[2];
  Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor> faces;
};

void read(std::istream& in, Rows& m) { in.read(reinterpret_cast<char*>(m.data()), m.size() * 8); }

bool read(std::istream& in, Scene& scene) {
  std::int64_t sizes[2];
  if (!in.read(reinterpret_cast<char*>(sizes), sizeof sizes)) return false;
  for (Rows& m : scene.x) m.resize(sizes[0], 3), read(in, m);
  scene.faces.resize(sizes[1], 3);
  in.read(reinterpret_cast<char*>(scene.faces.data()), scene.faces.size() * 4);
  return bool(in);
}

bool touches(const scenes::Query& q) { return !oracle::surely_apart(q) && oracle::exact_ccd(q).collides; }

void count_crossings(const Scene& scene, const Rows& ends) {
  int crossings = 0, starts = 0;
  const Mesh mesh(scene.x[0], scene.faces);
  tests::for_all_pairs(mesh, [&](PairKind kind, int, int, const std::array<int, 4>& v) {
    const scenes::Query q = tests::query_of(kind, v, scene.x[0], ends);
    if (!touches(q)) return;
    scenes::Query rest = q;
    rest.t1 = rest.t0;
    ++(touches(rest) ? starts : crossings);
  });
  std::printf("%d %d\n", crossings, starts);
}

}  // namespace

int main(int argc, char** argv) {
  const bool truncate = argc == 5 && std::strcmp(argv[1], "truncate") == 0;
  if (!truncate && (argc != 4 || std::strcmp(argv[1], "crossings") != 0)) return 2;
  std::ifstream in(argv[2], std::ios::binary);
  std::fstream ends(argv[3], std::ios::binary | (truncate ? std::ios::out : std::ios::in));
  if (!in || !ends) return 1;
  for (Scene scene; read(in, scene);) {
    if (!truncate) {
      Rows end(scene.x[0].rows(), 3);
      read(ends, end);
      if (!ends) return 1;
      count_crossings(scene, end);
      continue;
    }
    TruncateOptions options;
    options.gap_share = std::atof(argv[4]);
    const TruncatedStep r = truncate_step(Mesh(scene.x[0], scene.faces), scene.x[0], scene.x[1], options);
    ends.write(reinterpret_cast<const char*>(r.positions.data()), std::streamsize(r.positions.size() * 8));
  }
  return ends ? 0 : 1;
}
