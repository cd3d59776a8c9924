// Scenes to try a property of the pipeline on.
#pragma once

#include <onset/onset.hpp>
#include <string>
#include <vector>

#include "tests/scenes/meshes.hpp"

namespace onset::tests {

struct NamedScene {
  std::string name;
  scenes::Scene scene;
  Mesh mesh() const { return Mesh(scene.x_t0, scene.faces); }
};

// Soups from sparse to dense, closed surfaces that meet, cloth that folds onto itself, ties.
std::vector<NamedScene> some_scenes();

// Every coordinate rounded to a multiple of 2^-20: translations and sums of a few such numbers are exact.
scenes::Scene on_grid(scenes::Scene scene);

// Whether two active sets are equal bit for bit: contacts, order, outcome.
bool same_bytes(const Contact& a, const Contact& b);
bool same_bytes(const ActiveSet& a, const ActiveSet& b);
// All but certainty and toi_hi, which depend on the window and the budgets.
bool same_but_certainty(const Contact& a, const Contact& b);
bool same_bytes(const StepResult& a, const StepResult& b);  // all but the statistics

}  // namespace onset::tests
