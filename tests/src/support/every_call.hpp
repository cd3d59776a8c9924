// Every public call, asked in one way: whoever tries something on all of them has them in one list.
#pragma once

#include <onset/onset.hpp>
#include <string>
#include <vector>

#include "tests/scenes/meshes.hpp"
#include "tests/src/support/answer.hpp"

namespace onset::tests {

// A scene, and what calls that go on from the answers of others are given.
struct Subject {
  // d_hat is this share of the size of the scene.
  explicit Subject(std::string name, scenes::Scene scene, CollisionRules rules = {},
                   double d_hat_share = 0.02);
  // A new one each time, that no call has left anything on.
  Mesh mesh() const { return Mesh(scene.x_t0, scene.faces, rules); }

  std::string name;
  scenes::Scene scene;
  CollisionRules rules;
  Eigen::MatrixXd dx;
  double d_hat;
  ActiveSet set;
  ClosePairs close;
  Candidates candidates;
  std::vector<double> safe;
  std::vector<VertexFaceQuery> vertex_face;
  std::vector<EdgeEdgeQuery> edge_edge;
};

// Some small ones, with rules of every kind, for which a call takes a millisecond.
std::vector<Subject> small_subjects();

struct Call {
  const char* name;
  // Whether it asks Options::progress.
  bool reports;
  void (*ask)(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);

  Answer operator()(const Mesh& mesh, const Subject& subject, const Options& options) const {
    Answer answer;
    ask(mesh, subject, options, answer);
    return answer;
  }
};
// All functions that include/onset declares are in it (tests/faults/test_every_call.cpp).
const std::vector<Call>& every_call();

}  // namespace onset::tests
