#include "files/mesh/mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <new>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/mesh/mesh_file.hpp"

namespace app {
namespace {

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

// Texts hold no byte 0; what a format is, its first bytes tell.
bool is_always_text(const std::string&, std::string_view, std::uint64_t) { return true; }

bool is_text_ply(const std::string&, std::string_view head, std::uint64_t) {
  return head.find("format binary_") == head.npos;
}

bool is_text_off(const std::string&, std::string_view head, std::uint64_t) {
  return head.substr(0, head.find('\n')).find("BINARY") == head.npos;
}

struct Format {
  MeshFile (*read)(const std::string& path, std::string_view bytes);
  bool (*is_text)(const std::string& path, std::string_view head, std::uint64_t size);
};

const std::map<std::string, Format> kFormats = {{".obj", {read_obj, is_always_text}},
                                                {".ply", {read_ply, is_text_ply}},
                                                {".off", {read_off, is_text_off}},
                                                {".stl", {read_stl, is_text_stl}}};

bool is_wide(std::string_view head) {
  return head.substr(0, 2) == "\xFF\xFE" || head.substr(0, 2) == "\xFE\xFF";
}

MeshFile read(InputFile& file, const std::string& path, const Format& format) {
  std::string bytes(1 << 16, '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  if (bytes.empty()) throw InputError(path + ": the file is empty");
  const bool is_text = format.is_text(path, bytes, file.size());
  if (is_text && is_wide(bytes)) throw InputError(path + ": UTF-16: save it as UTF-8");
  return format.read(path, read_rest(file, path, std::move(bytes), is_text));
}

}  // namespace

MeshFile read_mesh(const std::string& path) {
  const std::string ext = extension(path);
  const auto format = kFormats.find(ext);
  InputFile file(path);  // that it is not there says more than what it is called
  if (format == kFormats.end()) {
    const std::string out = way_out(path, ext);
    throw InputError(path + ": " + (out[0] == ' ' ? ext + out : out + ", .obj, .ply, .off or .stl expected"));
  }
  try {
    return read(file, path, format->second);
  } catch (const std::bad_alloc&) {
    throw InputError(path + ": not enough memory for its " + std::to_string(file.size()) + " bytes");
  }
}

}  // namespace app
