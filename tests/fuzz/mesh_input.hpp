// A mesh with rules, options and a motion, from bytes.
#pragma once

#include <Eigen/Core>
#include <onset/onset.hpp>
#include <vector>

#include "tests/fuzz/bytes.hpp"
#include "tests/scenes/random.hpp"
#include "tests/steps/support/scene_truth.hpp"

namespace onset::fuzz {

struct MeshInput {
  int vertices = 0;
  std::vector<std::array<int, 2>> edges;  // those of the faces among them
  std::vector<std::array<int, 3>> faces;
  Eigen::MatrixXd x_t0, x_t1;
  Options options;
  double gap_share = 0.2, d_hat = 1;
  CollisionRules rules;

  Mesh mesh() const;
  Mesh mesh_without_rules() const;
  // Finite and in range.
  bool is_usable() const;
};

constexpr int kMostVertices = 12, kMostElements = 6;

// Each describes one part; the later ones need the earlier.
void describe_elements(Bytes& bytes, MeshInput& input);
// Small whole numbers in some unit; all bits; or one by one, with copies of other coordinates and their
// neighbours, zeros, the smallest and the largest, what is not finite.
void describe_positions(Bytes& bytes, MeshInput& input);
void describe_options(Bytes& bytes, MeshInput& input);
void read_rules(Bytes& bytes, MeshInput& input);
MeshInput read_mesh_input(Bytes& bytes);

// Static vertices end where they start.
void hold_statics(MeshInput& input);

// The bytes of elements and positions of one of the scenes that tests of steps make; what is read behind them
// is random.
std::string seed_of_scene(scenes::Random& random);

std::string to_text(const MeshInput& input);

}  // namespace onset::fuzz
