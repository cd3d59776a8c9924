// Good files of every format that the programs read, and ways to damage them.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace onset::tests {

struct SampleFile {
  std::string name;  // its ending tells the format
  std::string bytes;
};

std::vector<SampleFile> mesh_files();
// queries.csv, truth.csv, pairs.json, flags.json and toi.csv, for the mesh of 6 vertices and 2 faces that
// share no vertex.
std::vector<SampleFile> query_files();

// Bytes turned, runs lost or copied, lines swapped, the end cut off, numbers made extreme: one of these.
void damage(std::string& bytes, std::mt19937_64& random);

}  // namespace onset::tests
