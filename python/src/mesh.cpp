// The mesh, and lists of its elements.
#include <onset/mesh.hpp>
#include <onset/tetrahedra.hpp>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/fields.hpp"
#include "conversion/rules.hpp"

namespace onset_python {
namespace {

using onset::Mesh;

// Of an array or a number of vertices.
Mesh made_mesh(nb::handle rest, nb::handle faces, nb::handle edges, nb::handle rules, int dimension) {
  const onset::Indices F = indices("faces", faces, 3);
  const onset::CollisionRules r = rules_of(rules);
  std::ptrdiff_t vertices = 0;
  if (is_whole_number(rest)) {
    vertices = whole_number("rest:", rest);
  } else {
    const PositionsArgument x("rest", rest);
    vertices = x->rows();
    if (x->cols() != 3 && x->cols() != 2)
      throw std::invalid_argument("rest has " + std::to_string(x->cols()) +
                                  " columns; it must be #V x 3, or #V x 2 in the plane");
    if (dimension == 0) dimension = int(x->cols());
  }
  if (dimension == 2 && F.rows() > 0)
    throw std::invalid_argument("a mesh in the plane has edges and no faces");
  const bool derive = edges.is_none() && dimension != 2;
  const onset::Indices E = indices("edges", edges, 2);
  return without_lock([&] {
    if (dimension == 2) return Mesh::in_plane(vertices, E, r);
    return derive ? Mesh(vertices, F, r) : Mesh(vertices, E, F, r);
  });
}

nb::object edges_of(const Mesh& mesh) {
  std::vector<std::array<int, 2>> rows;
  for (std::ptrdiff_t e = 0; e < mesh.num_edges(); ++e) rows.push_back(mesh.edge(e));
  return taken_array(std::move(rows));
}
nb::object faces_of(const Mesh& mesh) {
  std::vector<std::array<int, 3>> rows;
  for (std::ptrdiff_t f = 0; f < mesh.num_faces(); ++f) rows.push_back(mesh.face(f));
  return taken_array(std::move(rows));
}

nb::object surface_positions(const Mesh& mesh, nb::handle full) {
  return taken_array(mesh.surface_positions(PositionsArgument("full", full)))
      .attr("reshape")(mesh.num_vertices(), mesh.dimension());
}

std::ptrdiff_t checked_row(std::ptrdiff_t row, std::ptrdiff_t rows, const char* what) {
  if (row < 0 || row >= rows)
    throw nb::index_error((std::string(what) + " " + std::to_string(row) + " is out of range").c_str());
  return row;
}

void bind_surface(nb::module_& m) {
  using onset::TetrahedraSurface;
  nb::class_<TetrahedraSurface>(m, "TetrahedraSurface", doc("TetrahedraSurface"))
      .ONSET_ARRAY(TetrahedraSurface, faces)
      .ONSET_ARRAY(TetrahedraSurface, edges)
      .ONSET_ARRAY(TetrahedraSurface, full_vertices)
      .ONSET_ARRAY(TetrahedraSurface, surface_vertices)
      .def(
          "mesh", [](const TetrahedraSurface& s, nb::handle rules) { return s.mesh(rules_of(rules)); },
          nb::arg("rules") = nb::none(),
          nb::sig("def mesh(self, rules: CollisionRules | None = None) -> Mesh"),
          doc("TetrahedraSurface.mesh"));
  m.def(
      "surface_of_tetrahedra",
      [](nb::handle tetrahedra, nb::handle x) {
        const onset::Indices T = indices("tetrahedra", tetrahedra, 4);
        if (is_whole_number(x)) return onset::surface_of_tetrahedra(T, whole_number("x:", x));
        const PositionsArgument positions("x", x);
        return without_lock([&] { return onset::surface_of_tetrahedra(T, positions); });
      },
      nb::arg("tetrahedra"), nb::arg("x"),
      nb::sig(
          "def surface_of_tetrahedra(tetrahedra: numpy.typing.ArrayLike, x: numpy.typing.ArrayLike | int) -> "
          "TetrahedraSurface"),
      doc("surface_of_tetrahedra"));
}

void bind_edges(nb::module_& m) {
  m.def(
      "edges",
      [](nb::handle faces) {
        const onset::Indices F = indices("faces", faces, 3);
        return taken_array(without_lock([&] { return onset::edge_list(F); }));
      },
      nb::arg("faces"),
      nb::sig("def edges(faces: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.int32]"),
      doc("edge_list"));
  m.def(
      "complete_edges",
      [](nb::handle edges, nb::handle faces) {
        const onset::Indices E = indices("edges", edges, 2), F = indices("faces", faces, 3);
        return taken_array(without_lock([&] { return onset::complete_edge_list(E, F); }));
      },
      nb::arg("edges"), nb::arg("faces"),
      nb::sig("def complete_edges(edges: numpy.typing.ArrayLike, faces: numpy.typing.ArrayLike) -> "
              "numpy.typing.NDArray[numpy.int32]"),
      doc("complete_edge_list"));
}

}  // namespace

void bind_mesh(nb::module_& m) {
  nb::class_<Mesh>(m, "Mesh", doc("Mesh"))
      .def(
          "__init__",
          [](Mesh* mesh, nb::handle rest, nb::handle faces, nb::handle edges, nb::handle rules,
             int dimension) {
            if (dimension != 0 && dimension != 2 && dimension != 3)
              throw std::invalid_argument("dimension is " + std::to_string(dimension) +
                                          "; it must be 2 or 3");
            new (mesh) Mesh(made_mesh(rest, faces, edges, rules, dimension));
          },
          nb::arg("rest"), nb::arg("faces") = nb::none(), nb::arg("edges") = nb::none(),
          nb::arg("rules") = nb::none(), nb::arg("dimension") = 0,
          nb::sig("def __init__(self, rest: numpy.typing.ArrayLike | int, faces: numpy.typing.ArrayLike | "
                  "None = None, edges: "
                  "numpy.typing.ArrayLike | None = None, rules: CollisionRules | None = None, dimension: int "
                  "= 0) -> None"),
          "rest: #V x 3 positions, or #V x 2 in the plane, whose values are not used, or the number of "
          "vertices.\n"
          "faces: #F x 3, edges: #E x 2, ids of vertices; without edges those of the faces are derived.\n"
          "dimension: 2 or 3, where rest is a number; 0 is 3 then.\n"
          "Raises ValueError naming the row for what the library does not take.")
      .def_prop_rw(
          "rules", [](const Mesh& mesh) { return onset::CollisionRules(mesh.rules()); },
          [](Mesh& mesh, nb::handle rules) {
            const onset::CollisionRules r = rules_of(rules);
            Mesh changed = mesh;  // calls that run meanwhile have copies
            without_lock([&] { changed.set_rules(r); });
            mesh = changed;
          },
          nb::for_getter(nb::sig("def rules(self) -> CollisionRules")), nb::for_setter(nb::arg().none()),
          nb::for_setter(nb::sig("def rules(self, rules: CollisionRules | None, /) -> None")),
          "A copy of the rules; what is assigned replaces them. ValueError names the rule and the row that "
          "is wrong.")
      .def_prop_ro("dimension", &Mesh::dimension, doc("Mesh.dimension"))
      .def_prop_ro("num_vertices", &Mesh::num_vertices)
      .def_prop_ro("num_edges", &Mesh::num_edges, doc("Mesh.num_edges"))
      .def_prop_ro("num_faces", &Mesh::num_faces)
      .def_prop_ro("num_points", &Mesh::num_points, doc("Mesh.num_points"))
      .def_prop_ro("num_bodies", &Mesh::num_bodies, doc("Mesh.num_bodies"))
      .def_prop_ro("edges", &edges_of, nb::sig("def edges(self) -> numpy.typing.NDArray[numpy.int32]"),
                   "#E x 2 ids, a copy.")
      .def_prop_ro("faces", &faces_of, nb::sig("def faces(self) -> numpy.typing.NDArray[numpy.int32]"),
                   "#F x 3 ids, a copy.")
      .def(
          "components", [](const Mesh& mesh) { return taken_array(mesh.components()); },
          nb::sig("def components(self) -> numpy.typing.NDArray[numpy.int32]"), doc("Mesh.components"))
      .def(
          "body",
          [](const Mesh& mesh, std::ptrdiff_t v) {
            return mesh.body(checked_row(v, mesh.num_vertices(), "vertex"));
          },
          nb::arg("vertex"))
      .def_prop_ro("filter_counts", &Mesh::filter_counts, nb::rv_policy::copy, doc("Mesh.filter_counts"))
      .def(
          "set_full_vertices",
          [](Mesh& mesh, nb::handle full, std::ptrdiff_t count) {
            mesh.set_full_vertices(ids("ids", full), count);
          },
          nb::arg("ids"), nb::arg("full_vertices"),
          nb::sig("def set_full_vertices(self, ids: numpy.typing.ArrayLike, full_vertices: int) -> None"),
          doc("Mesh.set_full_vertices"))
      .def_prop_ro("num_full_vertices", &Mesh::num_full_vertices)
      .def(
          "full_vertex",
          [](const Mesh& mesh, std::ptrdiff_t v) {
            return mesh.full_vertex(checked_row(v, mesh.num_vertices(), "vertex"));
          },
          nb::arg("vertex"))
      .def("surface_positions", &surface_positions, nb::arg("full"),
           nb::sig("def surface_positions(self, full: numpy.typing.ArrayLike) -> "
                   "numpy.typing.NDArray[numpy.float64]"),
           doc("Mesh.surface_positions"))
      .def("release_memory", &Mesh::release_memory, doc("Mesh.release_memory"))
      .def("__repr__", [](const Mesh& mesh) {
        return "Mesh(" + std::to_string(mesh.num_vertices()) + " vertices, " +
               std::to_string(mesh.num_edges()) + " edges, " + std::to_string(mesh.num_faces()) + " faces)";
      });
  bind_surface(m);
  bind_edges(m);
}

}  // namespace onset_python
