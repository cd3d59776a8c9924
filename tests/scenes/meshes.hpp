// Seeded meshes in motion, for tests of the broad phase and of the pipeline.
#pragma once

#include <Eigen/Core>

#include "tests/scenes/random.hpp"

namespace onset::scenes {

struct Scene {
  Eigen::MatrixXd x_t0, x_t1;  // #V x 3
  Eigen::MatrixXi faces;       // #F x 3; the edges are onset::edges(faces)
};

// Independent triangles of edge length about `size`, spread over [-1, 1]^3, each vertex displaced by up to
// `speed` per axis. No vertex is shared.
Scene triangle_soup(int faces, double size, double speed, Random& random);

// A grid of rows x cols vertices (>= 2 each) over [0, 1]^2 at z = 0, diagonals alternating; at rest.
Scene cloth(int rows, int cols);

// A closed sphere of radius 1: `rings` (>= 2) circles of latitude of `segments` (>= 3) vertices and two
// poles; at rest.
Scene sphere(int rings, int segments);

// The cube [-1, 1]^3, 8 vertices and 12 faces, at rest.
Scene cube();

// Both scenes in one, vertices and faces of `a` first.
Scene joined(const Scene& a, const Scene& b);

Scene translated(Scene scene, const Eigen::RowVector3d& offset);  // at both ends
void displace(Scene& scene, const Eigen::RowVector3d& step);      // adds to x_t1
void shake(Scene& scene, double size, Random& random);            // adds noise in [-size, size]^3 to x_t1

// A sphere of radius 1 that moves down by `step` onto a cube whose top is `gap` below it. Closed surfaces, no
// contact at t = 0; the step makes contact iff step >= gap, at the south pole, in the interior of a face: toi
// = gap / step up to rounding.
Scene sphere_onto_cube(int rings, int segments, double gap, double step);

// Two unit spheres that approach each other along x, the second one turned so that no symmetry is left.
Scene sphere_onto_sphere(int rings, int segments, double gap, double step);

}  // namespace onset::scenes
