#include "elastic/frames.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/output.hpp"
#include "files/text_lines.hpp"
#include "simulation/output.hpp"

namespace elastic {
namespace {

constexpr const char* kStep = "<!-- step ";
constexpr std::uint8_t kTetrahedron = 10;  // VTK's number of the cell

template <class T>
void append(std::string& to, const std::vector<T>& values) {
  const std::uint64_t size = values.size() * sizeof(T);
  to.append(reinterpret_cast<const char*>(&size), sizeof size);
  to.append(reinterpret_cast<const char*>(values.data()), size);
}

std::vector<double> doubles(const Vector& x) { return {x.data(), x.data() + x.size()}; }

// All but the step's number and the arrays' values is decided by these two numbers.
struct Layout {
  std::uint64_t points, velocity, connectivity, offsets, types;  // where each array starts
  Layout(std::size_t vertices, std::size_t tetrahedra)
      : points(0),
        velocity(8 + 24 * vertices),
        connectivity(2 * velocity),
        offsets(connectivity + 8 + 32 * tetrahedra),
        types(offsets + 8 + 8 * tetrahedra) {}
};

std::string header(std::size_t vertices, std::size_t tetrahedra, int step) {
  const Layout at(vertices, tetrahedra);
  const auto array = [](const char* type, const char* name, const char* more, std::uint64_t offset) {
    return app::format("<DataArray type=\"%s\" Name=\"%s\"%s format=\"appended\" offset=\"%llu\"/>\n", type,
                       name, more, (unsigned long long)offset);
  };
  const char* three = " NumberOfComponents=\"3\"";
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n" +
         (kStep + std::to_string(step) + " -->\n<UnstructuredGrid>\n") +
         app::format("<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n", vertices, tetrahedra) +
         "<Points>\n" + array("Float64", "Points", three, at.points) + "</Points>\n<PointData>\n" +
         array("Float64", "velocity", three, at.velocity) + "</PointData>\n<Cells>\n" +
         array("Int64", "connectivity", "", at.connectivity) + array("Int64", "offsets", "", at.offsets) +
         array("UInt8", "types", "", at.types) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
}

std::string body(const State& state, const std::vector<Tetrahedron>& tetrahedra) {
  std::string bytes;
  append(bytes, doubles(state.x));
  append(bytes, doubles(state.velocity));
  std::vector<std::int64_t> connectivity, offsets;
  for (const Tetrahedron& t : tetrahedra) {
    connectivity.insert(connectivity.end(), t.begin(), t.end());
    offsets.push_back(std::int64_t(connectivity.size()));
  }
  append(bytes, connectivity);
  append(bytes, offsets);
  append(bytes, std::vector<std::uint8_t>(tetrahedra.size(), kTetrahedron));
  return bytes + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace

void write_frame(const std::string& path, const State& state, const std::vector<Tetrahedron>& tetrahedra) {
  app::Output file(path);
  file.write(header(std::size_t(state.x.size() / 3), tetrahedra.size(), state.step));
  file.write(body(state, tetrahedra));
  file.publish();
}

State read_frame(const std::string& path, std::size_t vertices, const std::vector<Tetrahedron>& tetrahedra) {
  const auto fail = [&](const std::string& cause) { throw app::InputError(path + ": " + cause); };
  app::InputFile file(path);
  const std::string all = app::read_rest(file, path, "", false);
  State state;
  const std::size_t place = all.find(kStep);
  if (place == std::string::npos) fail("no frame of onset_elastic");
  const std::size_t first = place + std::strlen(kStep), last = all.find(" -->", first);
  const auto step = last == std::string::npos || last - first > 9
                        ? std::nullopt
                        : app::parse_whole(std::string_view(all).substr(first, last - first));
  if (!step || *step < 0) fail("no frame of onset_elastic");
  state.step = int(*step);
  state.x = state.velocity = Vector::Zero(3 * Eigen::Index(vertices));
  const std::string head = header(vertices, tetrahedra.size(), state.step);
  if (all.size() != head.size() + body(state, tetrahedra).size() || all.compare(0, head.size(), head) != 0)
    fail("a frame of another scene");
  const Layout at(vertices, tetrahedra.size());
  std::memcpy(state.x.data(), all.data() + head.size() + at.points + 8, 24 * vertices);
  std::memcpy(state.velocity.data(), all.data() + head.size() + at.velocity + 8, 24 * vertices);
  if (all.compare(head.size(), std::string::npos, body(state, tetrahedra)) != 0)
    fail("a frame of another scene");
  if (!state.x.allFinite() || !state.velocity.allFinite()) fail("a number that is not finite");
  return state;
}

void write_series(const std::string& path, const std::vector<int>& steps, double time_step) {
  app::Output file(path);
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const int step : steps)
    text += app::format("<DataSet timestep=\"%.17g\" file=\"%s\"/>\n", step * time_step,
                        frame_path("", step, "vtu").c_str());
  file.write(text + "</Collection>\n</VTKFile>\n");
  file.publish();
}

}  // namespace elastic
