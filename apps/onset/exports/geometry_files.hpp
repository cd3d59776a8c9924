// Contacts, candidates and swept primitives as PLY, coloured by time of impact, for MeshLab, ParaView or
// Blender.
#pragma once

#include <onset/onset.hpp>
#include <string>
#include <vector>

#include "files/scene/scene.hpp"
#include "onset/results/outputs.hpp"

namespace app {

// NAME-contacts.ply, NAME-swept.ply and NAME-candidates.ply, NAME being `path` without ".ply".
std::vector<std::string> geometry_files(const std::string& path);

// NAME-contacts.ply: a point a contact, halfway between p1 and p2 at its toi, with its normal.
// NAME-candidates.ply: an edge a candidate, between the middles of the two primitives at t = 0 (all of them:
// mind the size). NAME-swept.ply: what each primitive of a contact passes over in the step: a vertex's path
// and an edge's quadrilateral, and the mesh at t = 0. Every vertex has a toi (-1: none) and its colour.
void write_geometry(const std::string& path, const Scene& scene, const onset::Options& options,
                    const onset::ActiveSet& set, Outputs& outputs);

}  // namespace app
