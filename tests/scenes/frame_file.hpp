// Steps of real simulations with truth: two frames, the listed pairs, and whether each collides.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "tests/queries/query.hpp"

namespace onset::scenes {

struct Frame {
  Eigen::MatrixXd x;      // #V x 3
  Eigen::MatrixXi faces;  // #F x 3
};

// Binary PLY, either endian; vertices first, x y z of type float or double and nothing else, then faces as
// lists of three ids. Throws std::runtime_error for anything else.
Frame read_frame(const std::string& path);

// One step of $ONSET_DATA/scenes.
struct RecordedStep {
  const char* name;   // folder
  const char* frame;  // prefix of the frames' names
  int number;         // of the first frame
};
const std::vector<RecordedStep>& recorded_steps();

// A pair of one step: element ids (vertex and face, or two edges in the order of onset::edges) and its truth.
struct LabelledPair {
  int a, b;
  bool collides;
};
struct Recording {
  Frame t0, t1;
  std::vector<LabelledPair> vertex_face, edge_edge;
};
Recording read_recording(const std::string& data_folder, const RecordedStep& step);

// The query of one pair; `edges` are those of t0.faces.
Query query_of(const Recording& recording, PairKind kind, const LabelledPair& pair,
               const std::vector<std::array<int, 2>>& edges);

}  // namespace onset::scenes
