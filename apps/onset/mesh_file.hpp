// Reads a triangle mesh from PLY (ascii, binary of both endians, float or double), OBJ or OFF.
#pragma once

#include <Eigen/Core>
#include <string>

namespace app {

using Faces = Eigen::Matrix<long long, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

struct MeshFile {
  std::string path;
  Points positions;  // #V x 3, the file's order
  Faces faces;       // #F x 3, the file's order; ids as the file has them, in range or not
};

// The format is taken from the extension, whatever its case. Throws InputError naming the file and the cause:
// missing, unreadable, a position that is not three finite numbers, a face that is no triangle, no faces.
MeshFile read_mesh(const std::string& path);

}  // namespace app
