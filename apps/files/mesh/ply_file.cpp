// CGAL 5.5's reader was in this place before: it drops edges, takes 16-bit indices for others, sizes what it
// reads by counts that no file of that length can hold, and cannot tell the line of a fault.
#include <algorithm>

#include "files/mesh/mesh_file.hpp"
#include "files/mesh/ply_body.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

// Ids of what a property is for; none: it is skipped.
using Roles = std::vector<int>;
constexpr int kSkipped = -1;

bool is_index_list(const PlyProperty& p) {
  return p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
}

class PlyReader {
 public:
  PlyReader(const std::string& path, std::string_view bytes)
      : mesh_(path, 0), header_(read_ply_header(bytes, mesh_)), body_(make_ply_body(header_, mesh_)) {}

  MeshFile read() {
    const auto is_vertex = [](const PlyElement& e) { return e.name == "vertex"; };
    if (std::none_of(header_.elements.begin(), header_.elements.end(), is_vertex))
      mesh_.fail(0, "no element vertex");
    for (const PlyElement& element : header_.elements) {
      check_size(element);
      if (element.name == "vertex")
        vertices(element);
      else if (element.name == "face")
        faces(element);
      else if (element.name == "edge")
        edges(element);
      else
        others(element);
    }
    body_->end();
    return mesh_.finish();
  }

 private:
  // Before anything is made as large as a count says.
  void check_size(const PlyElement& e) {
    const bool ascii = header_.encoding == PlyHeader::Encoding::ascii;
    const std::size_t each = e.least_bytes(ascii);
    if (each > 0 && std::size_t(e.count) > (body_->bytes_left() + ascii) / each)
      mesh_.fail(e.line, "element " + e.name + " has count " + std::to_string(e.count) + ", the file has " +
                             std::to_string(body_->bytes_left()) + " bytes left");
  }

  // Reads each row, its values with a role by use(role, property), and calls row() behind it.
  template <class Use, class Row>
  void rows(const PlyElement& e, const char* what, const Roles& roles, Use&& use, Row&& row) {
    for (std::int64_t i = 0; i < e.count; ++i) {
      body_->begin_row({what, i, 0});
      for (std::size_t k = 0; k < roles.size(); ++k) {
        const PlyProperty& p = e.properties[k];
        if (roles[k] != kSkipped)
          use(roles[k], p);
        else
          body_->skip(p.type, p.list ? body_->length(p) : 1);
      }
      body_->end_row();
      row();
    }
  }

  void vertices(const PlyElement& e) {
    Roles roles(e.properties.size(), kSkipped);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      const std::size_t k = find(e, name);
      if (k == e.properties.size() && axis == 2 && e.count > 0)
        mesh_.fail(e.line,
                   "no vertex property z: for two dimensions add a third coordinate of 0, and give --dim 2");
      if (k == e.properties.size()) mesh_.fail(e.line, "no vertex property " + name);
      if (e.properties[k].list) mesh_.fail(e.properties[k].line, "vertex property " + name + " is a list");
      roles[k] = axis;
    }
    std::array<double, 3> position{};
    rows(
        e, "vertex", roles,
        [&](int axis, const PlyProperty& p) { position[std::size_t(axis)] = body_->real(p.type); },
        [&] { mesh_.vertex(position, body_->place().line, body_->text()); });
  }

  void faces(const PlyElement& e) {
    const Roles roles = list_roles(e);
    if (e.count > 0 && !has_role(roles)) mesh_.fail(e.line, "no face property vertex_indices");
    rows(
        e, "face", roles, [&](int, const PlyProperty& p) { read_ids(p); },
        [&] { mesh_.face(ids_, body_->place()); });
  }

  // vertex1 and vertex2, or a list.
  void edges(const PlyElement& e) {
    Roles roles = list_roles(e);
    const std::size_t first = find(e, "vertex1"), second = find(e, "vertex2"), none = e.properties.size();
    const bool ends = first < none && second < none;
    if (ends) roles.assign(none, kSkipped), roles[first] = 0, roles[second] = 1;
    if (e.count > 0 && !has_role(roles)) mesh_.fail(e.line, "no edge properties vertex1 and vertex2");
    for (std::size_t k = 0; k < none; ++k)
      if (roles[k] != kSkipped) check_index(e.properties[k], ends);
    if (ends) ids_.assign(2, 0);
    rows(
        e, "edge", roles,
        [&](int end, const PlyProperty& p) {
          if (ends)
            ids_[std::size_t(end)] = body_->whole(p.type);
          else
            read_ids(p);
        },
        [&] { mesh_.polyline(ids_, body_->place()); });
  }

  void others(const PlyElement& e) {
    if (e.name == "tristrips" && e.count > 0)
      mesh_.fail(e.line, "triangle strips are not read: write triangles, with MeshLab say");
    rows(
        e, e.name.c_str(), Roles(e.properties.size(), kSkipped), [](int, const PlyProperty&) {}, [] {});
    if (e.count > 0) mesh_.note("skipped element " + e.name + ", " + counted(std::size_t(e.count), "row"));
  }

  static std::size_t find(const PlyElement& e, const std::string& name) {
    const auto found = std::find_if(e.properties.begin(), e.properties.end(),
                                    [&](const PlyProperty& p) { return p.name == name; });
    return std::size_t(found - e.properties.begin());
  }

  // The first list of vertex indices has a role.
  Roles list_roles(const PlyElement& e) {
    Roles roles(e.properties.size(), kSkipped);
    const auto list = std::find_if(e.properties.begin(), e.properties.end(), is_index_list);
    if (list == e.properties.end()) return roles;
    check_index(*list, false);
    roles[std::size_t(list - e.properties.begin())] = 0;
    return roles;
  }

  static bool has_role(const Roles& roles) {
    return std::any_of(roles.begin(), roles.end(), [](int role) { return role != kSkipped; });
  }

  void check_index(const PlyProperty& p, bool single) {
    if (single && p.list) mesh_.fail(p.line, "property " + p.name + " is a list, one index expected");
    if (!is_whole(p.type)) mesh_.fail(p.line, "property " + p.name + " has float values, indices expected");
  }

  void read_ids(const PlyProperty& p) {
    ids_.resize(std::size_t(body_->length(p)));
    for (std::int64_t& id : ids_) id = body_->whole(p.type);
  }

  MeshBuilder mesh_;
  PlyHeader header_;
  std::unique_ptr<PlyBody> body_;
  std::vector<std::int64_t> ids_;
};

}  // namespace

MeshFile read_ply(const std::string& path, std::string_view bytes) { return PlyReader(path, bytes).read(); }

}  // namespace app
