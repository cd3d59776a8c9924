// Prints a line for every public call on small scenes with rules of every kind, and one for single queries of
// each family, with a hash of all that was asked and one of all that was answered: the same lines on every
// platform.
//   onset_print_answers [QUERIES]     queries of each family and kind; default 100
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "tests/scenes/families.hpp"
#include "tests/src/support/every_call.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Scenes are made with sines, whose last bits are not those of every C library: here in single precision.
Subject rounded(const Subject& made) {
  scenes::Scene scene = made.scene;
  scene.x_t0 = scene.x_t0.cast<float>().cast<double>().eval();
  scene.x_t1 = scene.x_t1.cast<float>().cast<double>().eval();
  return Subject(made.name, scene, made.rules);
}

void print_calls() {
  for (const Subject& made : small_subjects()) {
    const Subject subject = rounded(made);
    Answer asked;
    asked.add(subject.scene.x_t0, subject.scene.x_t1);
    for (const Call& call : every_call())
      std::printf("%s, %s: %016" PRIx64 " %016" PRIx64 "\n", subject.name.c_str(), call.name, asked.hash(),
                  call(subject.mesh(), subject, Options()).hash());
  }
}

void print_queries(int count) {
  for (const scenes::Family& family : scenes::families())
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, 1);
      Answer asked, answered;
      for (int i = 0; i < count; ++i) {
        const scenes::Query q = family.make(kind, random);
        asked.add(q.t0, q.t1);
        for (const Exactness exactness : {Exactness::conservative, Exactness::exact}) {
          Options options;
          options.exactness = exactness;
          answered.add(scenes::ccd(q, options));
        }
      }
      std::printf("%s, %s: %016" PRIx64 " %016" PRIx64 "\n", family.name, to_string(kind), asked.hash(),
                  answered.hash());
    }
}

}  // namespace

int main(int argc, char** argv) {
  print_calls();
  print_queries(argc > 1 ? std::atoi(argv[1]) : 100);
}
