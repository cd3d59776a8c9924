#include "files/mesh/mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>

#include "files/error.hpp"
#include "files/input_output.hpp"
#include "files/mesh/mesh_file.hpp"

namespace app {
namespace {

using Reader = MeshFile (*)(const std::string& path, std::string_view bytes);

std::string extension(const std::string& path) {
  std::string ext = std::filesystem::path(path).extension().string();
  std::transform(ext.begin(), ext.end(), ext.begin(), [](unsigned char c) { return std::tolower(c); });
  return ext;
}

// Formats that people have, and what turns them into one that is read.
std::string way_out(const std::string& path, const std::string& ext) {
  const std::string stem = path.substr(0, path.size() - ext.size());
  for (const char* known : {".msh", ".vtk", ".vtu", ".xdmf", ".inp", ".med", ".bdf", ".mesh", ".e", ".exo"})
    if (ext == known)
      return " is not read: convert it with 'meshio convert " + path + " " + stem +
             ".ply' (pip install meshio; triangles and quads, not tetrahedra)";
  for (const char* known :
       {".gltf", ".glb", ".fbx", ".dae", ".3mf", ".usd", ".usda", ".usdc", ".usdz", ".abc", ".blend"})
    if (ext == known) return " is not read: export it as .obj or .ply, from Blender say";
  for (const char* known : {".stp", ".step", ".igs", ".iges", ".brep"})
    if (ext == known) return " is not read: mesh it with 'gmsh -2 " + path + " -o " + stem + ".stl'";
  return ext.empty() ? "no extension" : "unknown extension " + ext;
}

std::string read_all(const std::string& path) {
  std::ifstream in = open_input(path);
  std::string bytes;
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (!unknown) bytes.reserve(size);
  std::vector<char> chunk(1 << 16);
  errno = 0;
  while (in.read(chunk.data(), std::streamsize(chunk.size())) || in.gcount() > 0)
    bytes.append(chunk.data(), std::size_t(in.gcount()));
  if (in.bad()) throw InputError(path + ": cannot be read: " + std::strerror(errno));
  return bytes;
}

}  // namespace

MeshFile read_mesh(const std::string& path) {
  static const std::map<std::string, Reader> readers = {
      {".obj", read_obj}, {".ply", read_ply}, {".off", read_off}, {".stl", read_stl}};
  const std::string ext = extension(path);
  const auto reader = readers.find(ext);
  open_input(path);  // that it is not there says more than what it is called
  if (reader == readers.end()) {
    const std::string out = way_out(path, ext);
    throw InputError(path + ": " + (out[0] == ' ' ? ext + out : out + ", .obj, .ply, .off or .stl expected"));
  }
  const std::string bytes = read_all(path);
  if (bytes.empty()) throw InputError(path + ": the file is empty");
  return reader->second(path, bytes);
}

}  // namespace app
