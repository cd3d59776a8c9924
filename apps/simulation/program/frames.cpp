#include "simulation/program/frames.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/output.hpp"
#include "files/text_lines.hpp"
#include "simulation/program/output.hpp"

namespace simulation {
namespace {

constexpr const char *kStep = "<!-- step ", *kTurned = ", turned until ", *kEnd = " -->";
constexpr std::uint8_t kTriangle = 5, kTetrahedron = 10;  // VTK's numbers of the cells

template <class T>
void append(std::string& to, const std::vector<T>& values) {
  const std::uint64_t size = values.size() * sizeof(T);
  to.append(reinterpret_cast<const char*>(&size), sizeof size);
  to.append(reinterpret_cast<const char*>(values.data()), size);
}

std::vector<double> doubles(const Vector& x) { return {x.data(), x.data() + x.size()}; }

// Where each array starts.
struct Layout {
  std::uint64_t points, velocity, connectivity, offsets, types;
  Layout(std::size_t vertices, const Cells& cells)
      : points(0),
        velocity(8 + 24 * vertices),
        connectivity(2 * velocity),
        offsets(connectivity + 8 + 8 * cells.vertices.size()),
        types(offsets + 8 + 8 * cells.size()) {}
};

std::string header(std::size_t vertices, const Cells& cells, const State& state) {
  const Layout at(vertices, cells);
  const auto array = [](const char* type, const char* name, const char* more, std::uint64_t offset) {
    return app::format("<DataArray type=\"%s\" Name=\"%s\"%s format=\"appended\" offset=\"%llu\"/>\n", type,
                       name, more, (unsigned long long)offset);
  };
  const char* three = " NumberOfComponents=\"3\"";
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n" +
         app::format("%s%d%s%.17g%s\n<UnstructuredGrid>\n", kStep, state.step, kTurned, state.turned_until,
                     kEnd) +
         app::format("<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n", vertices, cells.size()) +
         "<Points>\n" + array("Float64", "Points", three, at.points) + "</Points>\n<PointData>\n" +
         array("Float64", "velocity", three, at.velocity) + "</PointData>\n<Cells>\n" +
         array("Int64", "connectivity", "", at.connectivity) + array("Int64", "offsets", "", at.offsets) +
         array("UInt8", "types", "", at.types) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
}

std::string body(const State& state, const Cells& cells) {
  std::string bytes;
  append(bytes, doubles(state.x));
  append(bytes, doubles(state.velocity));
  std::vector<std::int64_t> offsets;
  for (std::size_t c = 1; c <= cells.size(); ++c) offsets.push_back(std::int64_t(c) * cells.corners);
  append(bytes, std::vector<std::int64_t>(cells.vertices.begin(), cells.vertices.end()));
  append(bytes, offsets);
  append(bytes, std::vector<std::uint8_t>(cells.size(), cells.corners == 3 ? kTriangle : kTetrahedron));
  return bytes + "\n</AppendedData>\n</VTKFile>\n";
}

// The words between two marks.
std::optional<std::string_view> between(std::string_view all, const char* before, const char* after) {
  const std::size_t place = all.find(before);
  if (place == std::string::npos) return {};
  const std::size_t first = place + std::strlen(before), last = all.find(after, first);
  if (last == std::string::npos || last - first > 30) return {};
  return all.substr(first, last - first);
}

}  // namespace

void write_frame(const std::string& path, const State& state, const Cells& cells) {
  app::Output file(path);
  file.write(header(std::size_t(state.x.size() / 3), cells, state));
  file.write(body(state, cells));
  file.publish();
}

State read_frame(const std::string& path, std::size_t vertices, const Cells& cells) {
  const auto fail = [&](const std::string& cause) { throw app::InputError(path + ": " + cause); };
  app::InputFile file(path);
  const std::string all = app::read_rest(file, path, "", false);
  State state;
  const auto words = between(all, kStep, kTurned), time = between(all, kTurned, kEnd);
  const double step = words && words->size() <= 9 ? double(app::parse_whole(*words).value_or(-1)) : -1;
  const double turned = time ? app::parse_double(*time).value_or(-1) : -1;
  if (!(step >= 0 && turned >= 0)) fail("no frame of this program");
  state.step = int(step);
  state.turned_until = turned;
  state.x = state.velocity = Vector::Zero(3 * Eigen::Index(vertices));
  const std::string head = header(vertices, cells, state);
  if (all.size() != head.size() + body(state, cells).size() || all.compare(0, head.size(), head) != 0)
    fail("a frame of another scene");
  const Layout at(vertices, cells);
  std::memcpy(state.x.data(), all.data() + head.size() + at.points + 8, 24 * vertices);
  std::memcpy(state.velocity.data(), all.data() + head.size() + at.velocity + 8, 24 * vertices);
  if (all.compare(head.size(), std::string::npos, body(state, cells)) != 0) fail("a frame of another scene");
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

}  // namespace simulation
