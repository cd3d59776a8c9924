// The rules of a scene.

#include "conversion/rules.hpp"

#include <limits>
#include <onset/collision_rules.hpp>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/fields.hpp"
#include "conversion/records.hpp"
#include "conversion/reprs.hpp"

namespace onset_python {
namespace {

using onset::BodySeparation, onset::CollisionRules, onset::Plane;

nb::object array_from(const std::vector<bool>& values) {
  return taken_array(std::vector<std::uint8_t>(values.begin(), values.end())).attr("view")("bool");
}
template <class T>
nb::object array_from(const std::vector<T>& values) {
  return taken_array(std::vector<T>(values));
}

std::vector<Plane> planes_of(nb::handle values) {
  std::vector<Plane> list;
  for (const nb::handle value : values) {
    Plane p;
    if (!nb::try_cast(value, p)) throw nb::type_error("planes must be of Plane");
    list.push_back(p);
  }
  return list;
}

// (body_a, body_b, separation).
std::optional<BodySeparation> separation_of(nb::handle value) {
  BodySeparation s;
  if (nb::try_cast(value, s)) return s;
  if (!nb::isinstance<nb::sequence>(value) || nb::len(value) != 3) return std::nullopt;
  const std::optional<double> separation = real_number(value[2]);
  if (!separation || !nb::try_cast(value[0], s.body_a, false) || !nb::try_cast(value[1], s.body_b, false))
    return std::nullopt;
  s.separation = *separation;
  return s;
}

std::vector<BodySeparation> body_separations_of(nb::handle values) {
  std::vector<BodySeparation> list;
  for (const nb::handle value : values) {
    const std::optional<BodySeparation> s = separation_of(value);
    if (!s)
      throw nb::type_error("body_separations must be of BodySeparation, or (body_a, body_b, separation)");
    list.push_back(*s);
  }
  return list;
}

template <class T>
nb::tuple tuple_from(const std::vector<T>& values) {
  nb::list list;
  for (const T& value : values) list.append(nb::cast(value));
  return nb::tuple(list);
}

nb::object rest_of(const CollisionRules& rules) {
  if (rules.rest_positions.rows() == 0) return nb::none();
  const onset::StoredPositions& x = rules.rest_positions;
  std::vector<double> values;
  for (std::ptrdiff_t r = 0; r < x.rows(); ++r)
    for (std::ptrdiff_t c = 0; c < x.cols(); ++c) values.push_back(x(r, c));
  return taken_array(std::move(values)).attr("reshape")(x.rows(), x.cols());
}

void set_rest(CollisionRules& rules, nb::handle x) {
  if (x.is_none())
    rules.rest_positions = {};
  else
    rules.rest_positions = onset::StoredPositions(*PositionsArgument("rest_positions", x).operator->());
}

// A member that is a list of numbers: read as an array of numpy, set from anything that is like one.
#define ONSET_RULE(member, read)                                                                          \
  def_prop_rw(                                                                                            \
      #member, [](const CollisionRules& r) { return array_from(r.member); },                              \
      [](CollisionRules& r, nb::handle values) { r.member = read(#member, values); },                     \
      nb::for_setter(nb::arg().none()),                                                                   \
      nb::for_setter(nb::sig("def " #member "(self, values: numpy.typing.ArrayLike | None, /) -> None")), \
      nb::for_getter(nb::sig("def " #member "(self) -> numpy.typing.NDArray")),                           \
      doc("CollisionRules." #member))

// A member that is one number or flag: what it cannot be is an error that names it.
#define ONSET_NUMBER(member, read, type, text)                                      \
  def_prop_rw(                                                                      \
      #member, [](const CollisionRules& r) { return r.member; },                    \
      [](CollisionRules& r, nb::handle value) { r.member = read(#member, value); }, \
      nb::for_getter(nb::sig("def " #member "(self) -> " type)),                    \
      nb::for_setter(nb::sig("def " #member "(self, value: " type ", /) -> None")), text)

[[noreturn]] void reject(const char* name, nb::handle value, const char* what) {
  const std::string text =
      std::string(name) + " must be " + what + ", not " + nb::cast<std::string>(nb::repr(value));
  throw nb::type_error(text.c_str());
}
bool flag_of(const char* name, nb::handle value) {
  if (PyBool_Check(value.ptr()) != 0) return value.is(nb::handle(Py_True));
  const std::optional<bool> flag = numpy_flag(value);
  if (!flag) reject(name, value, "True or False");
  return *flag;
}
int count_of(const char* name, nb::handle value) {
  if (!is_whole_number(value)) reject(name, value, "a whole number");
  const std::ptrdiff_t count = whole_number(name, value);
  const auto limits = std::numeric_limits<int>();
  if (count < limits.min() || count > limits.max())
    throw std::invalid_argument(std::string(name) + " " + std::to_string(count) + " is out of range");
  return int(count);
}
double share_of(const char* name, nb::handle value) {
  const std::optional<double> share = real_number(value);
  if (!share) reject(name, value, "a number");
  return *share;
}

const char* what_rules_are() {
  static const std::string text = std::string(doc("CollisionRules")) +
                                  "\n\nMembers are assigned as a whole, from anything that is like an array; "
                                  "what they give is read-only. Mesh.rules gives a "
                                  "copy: assign it again after a change.";
  return text.c_str();
}

void bind_collision_rules(nb::module_& m) {
  nb::class_<CollisionRules>(m, "CollisionRules", what_rules_are())
      .def(
          "__init__",
          [](CollisionRules* rules, const nb::kwargs& members) {
            if (members.size() == 0) {
              new (rules) CollisionRules();
              return;
            }
            const nb::object made = nb::type<CollisionRules>()();
            for (const auto& [name, value] : members) {
              if (!nb::hasattr(made, name)) {
                const std::string text =
                    std::string("there is no rule '") + nb::cast<std::string>(name) + "'";
                throw nb::type_error(text.c_str());
              }
              nb::setattr(made, name, value);
            }
            new (rules) CollisionRules(nb::cast<const CollisionRules&>(made));
          },
          nb::sig("def __init__(self, **rules: Any) -> None"))
      .ONSET_RULE(points, ids)
      .ONSET_RULE(thickness, doubles)
      .ONSET_RULE(bodies, ids)
      .ONSET_RULE(rigid_bodies, flags)
      .ONSET_RULE(bodies_without_self_collision, flags)
      .ONSET_RULE(excluded_bodies, id_pairs)
      .ONSET_RULE(static_vertices, flags)
      .ONSET_RULE(groups, bits)
      .ONSET_RULE(masks, bits)
      .ONSET_RULE(excluded_vertices, id_pairs)
      .ONSET_NUMBER(weld, flag_of, "bool", doc("CollisionRules.weld"))
      .ONSET_NUMBER(excluded_rings, count_of, "int", doc("CollisionRules.excluded_rings"))
      .ONSET_NUMBER(rest_share, share_of, "float", doc("CollisionRules.rest_positions"))
      .def_prop_rw(
          "rest_positions", &rest_of, &set_rest,
          nb::for_getter(nb::sig("def rest_positions(self) -> numpy.typing.NDArray[numpy.float64] | None")),
          nb::for_setter(nb::arg().none()),
          nb::for_setter(nb::sig("def rest_positions(self, x: numpy.typing.ArrayLike | None, /) -> None")),
          doc("CollisionRules.rest_positions"))
      .def_prop_rw(
          "planes", [](const CollisionRules& r) { return tuple_from(r.planes); },
          [](CollisionRules& r, nb::handle values) { r.planes = planes_of(values); },
          nb::for_getter(nb::sig("def planes(self) -> tuple[Plane, ...]")), nb::for_setter(nb::arg().none()),
          nb::for_setter(nb::sig("def planes(self, planes: Iterable[Plane], /) -> None")),
          doc("CollisionRules.planes"))
      .def_prop_rw(
          "body_separations", [](const CollisionRules& r) { return tuple_from(r.body_separations); },
          [](CollisionRules& r, nb::handle values) { r.body_separations = body_separations_of(values); },
          nb::for_getter(nb::sig("def body_separations(self) -> tuple[BodySeparation, ...]")),
          nb::for_setter(nb::arg().none()),
          nb::for_setter(nb::sig("def body_separations(self, separations: Iterable[BodySeparation | "
                                 "tuple[int, int, float]], /) -> None")),
          doc("CollisionRules.body_separations"))
      .def_prop_rw(
          "excluded_pairs", [](const CollisionRules& r) { return owned_records(r.excluded_pairs); },
          [](CollisionRules& r, nb::handle values) { r.excluded_pairs = pairs_of("excluded_pairs", values); },
          nb::for_getter(nb::sig("def excluded_pairs(self) -> numpy.typing.NDArray")),
          nb::for_setter(nb::arg().none()),
          nb::for_setter(nb::sig(
              "def excluded_pairs(self, pairs: numpy.typing.NDArray | Iterable[Pair] | None, /) -> None")),
          doc("CollisionRules.excluded_pairs"))
      .def_prop_rw(
          "excluded_intersections",
          [](const CollisionRules& r) { return owned_records(r.excluded_intersections); },
          [](CollisionRules& r, nb::handle values) {
            r.excluded_intersections = intersections_of("excluded_intersections", values);
          },
          nb::for_getter(nb::sig("def excluded_intersections(self) -> numpy.typing.NDArray")),
          nb::for_setter(nb::arg().none()),
          nb::for_setter(nb::sig(
              "def excluded_intersections(self, intersections: numpy.typing.NDArray | None, /) -> None")),
          doc("CollisionRules.excluded_intersections"));
}

}  // namespace

onset::CollisionRules rules_of(nb::handle rules) {
  onset::CollisionRules read;
  if (!rules.is_none() && !nb::try_cast(rules, read))
    throw nb::type_error("rules must be CollisionRules, or None");
  return read;
}

void bind_rules(nb::module_& m) {
  nb::class_<Plane>(m, "Plane", doc("Plane"))
      .def(
          "__init__",
          [](Plane* p, nb::handle normal, double offset, std::uint32_t group, std::uint32_t mask) {
            new (p) Plane{vector3("normal", normal), offset, group, mask};
          },
          nb::arg("normal"), nb::arg("offset") = 0.0, nb::arg("group") = ~0u, nb::arg("mask") = ~0u,
          nb::sig("def __init__(self, normal: numpy.typing.ArrayLike, offset: float = 0.0, group: int = "
                  "0xffffffff, mask: int = "
                  "0xffffffff) -> None"))
      .ONSET_FIELD(Plane, normal)
      .ONSET_FIELD(Plane, offset)
      .ONSET_FIELD(Plane, group)
      .ONSET_FIELD(Plane, mask)
      .def("__repr__", [](const Plane& p) {
        return "Plane([" + text_of(p.normal[0]) + ", " + text_of(p.normal[1]) + ", " + text_of(p.normal[2]) +
               "], offset=" + text_of(p.offset) + ")";
      });
  nb::class_<BodySeparation>(m, "BodySeparation", doc("BodySeparation"))
      .def(
          "__init__",
          [](BodySeparation* s, int a, int b, double separation) {
            new (s) BodySeparation{a, b, separation};
          },
          nb::arg("body_a"), nb::arg("body_b"), nb::arg("separation"))
      .ONSET_FIELD(BodySeparation, body_a)
      .ONSET_FIELD(BodySeparation, body_b)
      .ONSET_FIELD(BodySeparation, separation)
      .def("__repr__", [](const BodySeparation& s) {
        return "BodySeparation(" + std::to_string(s.body_a) + ", " + std::to_string(s.body_b) + ", " +
               text_of(s.separation) + ")";
      });
  bind_collision_rules(m);
}

}  // namespace onset_python
