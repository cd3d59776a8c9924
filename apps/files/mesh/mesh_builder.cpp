#include "files/mesh/mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/error.hpp"
#include "files/text_lines.hpp"

namespace app {

MeshBuilder::MeshBuilder(std::string path, std::int64_t base) : base_(base) { mesh_.path = std::move(path); }

void MeshBuilder::fail(std::size_t line, const std::string& cause) const {
  throw InputError(mesh_.path + (line > 0 ? ":" + std::to_string(line) : "") + ": " + shown(cause));
}

void MeshBuilder::fail(const Place& place, const std::string& cause) const {
  fail(place.line, std::string(place.what) + " " + std::to_string(place.row) + " " + cause);
}

void MeshBuilder::vertex(const std::array<double, 3>& p, std::size_t line, const std::string& text) {
  if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    fail({"vertex", vertices(), line}, "is not three finite numbers" + (text.empty() ? "" : ": " + text));
  positions_.push_back(p);
}

void MeshBuilder::out_of_range(std::int64_t id, const Place& place) const {
  const std::string count = std::to_string(vertices()), index = std::to_string(id + base_);
  if (vertices() == 0) fail(place, "has vertex index " + index + ", but there are no vertices");
  const std::string range = base_ == 0 ? "[0, " + count + ")" : "[1, " + count + "]";
  fail(place, "has vertex index " + index + ", not in " + range);
}

void MeshBuilder::check(std::int64_t id, const Place& place) {
  if (id < 0) out_of_range(id, place);
  if (id >= vertices() && (forward_.empty() || id > forward_.back().id)) forward_.push_back({id, place});
}

void MeshBuilder::check_different(const std::vector<std::int64_t>& ids, const Place& place) {
  if (ids.size() == 3 && ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0]) return;
  sorted_ = ids;
  std::sort(sorted_.begin(), sorted_.end());
  const auto twice = std::adjacent_find(sorted_.begin(), sorted_.end());
  if (twice == sorted_.end()) return;
  const std::string index = base_ == 0 ? "" : " (index " + std::to_string(*twice + base_) + ")";
  fail(place, "has vertex " + std::to_string(*twice) + index + " repeated");
}

void MeshBuilder::face(const std::vector<std::int64_t>& ids, const Place& place) {
  if (ids.empty()) fail(place, "has no vertices");
  if (ids.size() == 1) return point(ids[0], place);
  if (ids.size() == 2) return polyline(ids, place);
  for (const std::int64_t id : ids) check(id, place);
  check_different(ids, place);
  mesh_.polygons.corners.insert(mesh_.polygons.corners.end(), ids.begin(), ids.end());
  mesh_.polygons.ends.push_back(mesh_.polygons.corners.size());
}

void MeshBuilder::polyline(const std::vector<std::int64_t>& ids, const Place& place) {
  if (ids.size() < 2) fail(place, "has " + std::to_string(ids.size()) + " vertices, two or more expected");
  for (const std::int64_t id : ids) check(id, place);
  for (std::size_t i = 1; i < ids.size(); ++i) {
    if (ids[i] == ids[i - 1]) check_different({ids[i - 1], ids[i]}, place);
    mesh_.wires.push_back({ids[i - 1], ids[i]});
  }
}

void MeshBuilder::point(std::int64_t id, const Place& place) {
  check(id, place);
  mesh_.points.push_back(id);
}

MeshFile MeshBuilder::finish() {
  for (const Forward& f : forward_)
    if (f.id >= vertices()) out_of_range(f.id, f.place);
  if (vertices() == 0) fail(0, "no vertices");
  if (mesh_.polygons.size() == 0 && mesh_.wires.empty() && mesh_.points.empty()) {
    for (std::int64_t v = 0; v < vertices(); ++v) mesh_.points.push_back(v);
    note("no faces, wires or points: each vertex is a point");
  }
  mesh_.positions.resize(vertices(), 3);
  for (std::int64_t v = 0; v < vertices(); ++v)
    for (std::size_t c = 0; c < 3; ++c) mesh_.positions(v, Eigen::Index(c)) = positions_[std::size_t(v)][c];
  return std::move(mesh_);
}

}  // namespace app
