// Motion that is not linear, the library's and the caller's own.
#include <nanobind/trampoline.h>

#include <cmath>
#include <onset/trajectory.hpp>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"
#include "conversion/callbacks.hpp"
#include "conversion/options.hpp"
#include "conversion/signatures.hpp"

namespace onset_python {
namespace {

using onset::Mesh, onset::RigidTrajectory, onset::Trajectory;

// A trajectory written in Python: num_vertices(), body(vertex), positions(t, vertices) -> n x 3, straying(t0,
// t1, vertices) -> n.
class PythonTrajectory : public Trajectory {
 public:
  NB_TRAMPOLINE(Trajectory);

  std::ptrdiff_t num_vertices() const override {
    const Callback callback;
    callback.require();
    return number<std::ptrdiff_t>("num_vertices()", method("num_vertices")());
  }
  int body(std::ptrdiff_t vertex) const override {
    const Callback callback;
    callback.require();
    return number<int>("body()", method("body")(vertex));
  }
  void positions(double t, const int* vertices, std::size_t count, double* xyz) const override {
    const Callback callback;
    callback.require();
    const DoublesArgument x("positions()", method("positions")(t, list_of(vertices, count)));
    require("positions()", x, std::ptrdiff_t(count), 3);
    const std::vector<double> values = x.list();
    std::copy(values.begin(), values.end(), xyz);
  }
  void straying(double t0, double t1, const int* vertices, std::size_t count, double* bounds) const override {
    const Callback callback;
    callback.require();
    const DoublesArgument r("straying()", method("straying")(t0, t1, list_of(vertices, count)));
    require("straying()", r, std::ptrdiff_t(count), 1);
    const std::vector<double> values = r.list();
    std::copy(values.begin(), values.end(), bounds);
  }

 private:
  nb::object method(const char* name) const {
    const nb::object self = nb::find(static_cast<const Trajectory*>(this));
    if (!nb::hasattr(self, name)) {
      const std::string text = nb::cast<std::string>(nb::handle(self.type()).attr("__name__")) +
                               " is a Trajectory and must have " + name + "()";
      throw nb::type_error(text.c_str());
    }
    return self.attr(name);
  }
  template <class T>
  static T number(const char* name, const nb::object& value) {
    T result{};
    if (!nb::try_cast(value, result))
      throw nb::type_error((std::string(name) + " did not return a whole number that fits").c_str());
    return result;
  }
  static nb::object list_of(const int* vertices, std::size_t count) {
    return taken_array(std::vector<int>(vertices, vertices + count));
  }
  static void require(const char* name, const DoublesArgument& x, std::ptrdiff_t rows,
                      std::ptrdiff_t columns) {
    if (x.rows() != rows || x.cols() != columns)
      throw std::invalid_argument(std::string(name) + " returned " + std::to_string(x.rows()) + " x " +
                                  std::to_string(x.cols()) + " values for " + std::to_string(rows) +
                                  " vertices");
  }
};

nb::object at(const Trajectory& trajectory, double t) {
  if (!(t >= 0 && t <= 1))
    throw std::invalid_argument("t is " + std::to_string(t) + "; it must be in [0, 1]");
  const auto x = trajectory.at(t);  // with the lock: add_body may not change it meanwhile
  return taken_array(std::vector<double>(x.data(), x.data() + x.size())).attr("reshape")(x.rows(), 3);
}

int add_body(RigidTrajectory& motion, nb::handle vertices, nb::handle rotation, nb::handle translation,
             nb::handle centre) {
  const auto vector = [](const char* name, nb::handle values) {
    const std::array<double, 3> v = vector3(name, values);
    return Eigen::Vector3d(v[0], v[1], v[2]);
  };
  return motion.add_body(ids("vertices", vertices), vector("rotation", rotation),
                         vector("translation", translation), vector("centre", centre));
}

// What a class of the caller's own has to have, with the words of the header.
const char* what_to_write() {
  static const std::string text =
      std::string(doc("Trajectory")) + "\n\nWhat it must have:\n\nnum_vertices()\n\nbody(vertex):\n" +
      doc("Trajectory.body") + "\n\npositions(t, vertices), an array of len(vertices) x 3:\n" +
      doc("Trajectory.positions") + "\n\nstraying(t0, t1, vertices), an array of len(vertices):\n" +
      doc("Trajectory.straying");
  return text.c_str();
}

void bind_classes(nb::module_& m) {
  nb::class_<Trajectory, PythonTrajectory>(m, "Trajectory", what_to_write())
      .def(nb::init<>())
      .def_prop_ro_static(
          "kLinear", [](nb::handle) { return int(Trajectory::kLinear); }, doc("Trajectory.kLinear"))
      .def_prop_ro_static(
          "kFree", [](nb::handle) { return int(Trajectory::kFree); }, doc("Trajectory.kFree"))
      .def("at", &at, nb::arg("t"), nb::sig("def at(self, t: float) -> numpy.typing.NDArray[numpy.float64]"),
           doc("Trajectory.at"));
  nb::class_<RigidTrajectory, Trajectory>(m, "RigidTrajectory", nb::is_final(), doc("RigidTrajectory"))
      .def(
          "__init__",
          [](RigidTrajectory* motion, nb::handle x_t0, nb::handle x_t1) {
            const PositionsArgument x0("x_t0", x_t0);
            if (x_t1.is_none())
              new (motion) RigidTrajectory(x0);
            else
              new (motion) RigidTrajectory(x0, PositionsArgument("x_t1", x_t1));
          },
          nb::arg("x_t0"), nb::arg("x_t1") = nb::none(),
          nb::sig("def __init__(self, x_t0: " ONSET_ARRAY_LIKE ", x_t1: " ONSET_ARRAY_LIKE
                  " | None = None) -> None"),
          doc("RigidTrajectory.RigidTrajectory"))
      .def("add_body", &add_body, nb::arg("vertices"), nb::arg("rotation"), nb::arg("translation"),
           nb::arg("centre"),
           nb::sig("def add_body(self, vertices: " ONSET_ARRAY_LIKE ", rotation: " ONSET_ARRAY_LIKE
                   ", translation: " ONSET_ARRAY_LIKE ", centre: " ONSET_ARRAY_LIKE ") -> int"),
           doc("RigidTrajectory.add_body"))
      .def_prop_ro("num_vertices", &RigidTrajectory::num_vertices)
      .def(
          "body",
          [](const RigidTrajectory& motion, std::ptrdiff_t vertex) {
            if (vertex < 0 || vertex >= motion.num_vertices())
              throw nb::index_error("there is no such vertex");
            return motion.body(vertex);
          },
          nb::arg("vertex"), doc("Trajectory.body"));
}

// What a trajectory says must not change while a call reads it: a call on one that can change gets a copy.
template <class Call>
auto ask(const Mesh& mesh, const Trajectory& trajectory, const nb::kwargs& named, const Call& call) {
  const onset::Options options = options_of(named);
  if (const auto* rigid = dynamic_cast<const RigidTrajectory*>(&trajectory))
    return without_lock([&, mesh, motion = *rigid] { return call(mesh, motion, options); });
  return without_lock([&, mesh] { return call(mesh, trajectory, options); });
}

#define ONSET_TRAJECTORY_SIG(name, result) \
  nb::sig("def " name "(mesh: Mesh, trajectory: Trajectory, " ONSET_OPTIONS ") -> " result)

}  // namespace

void bind_trajectories(nb::module_& m) {
  bind_classes(m);
  m.def(
      "compute_collision_free_stepsize",
      [](const Mesh& mesh, const Trajectory& trajectory, const nb::kwargs& named) {
        return ask(mesh, trajectory, named, [](const Mesh& s, const Trajectory& t, const onset::Options& o) {
          return onset::compute_collision_free_stepsize(s, t, o);
        });
      },
      nb::arg("mesh"), nb::arg("trajectory"), nb::arg("options"),
      ONSET_TRAJECTORY_SIG("compute_collision_free_stepsize", "StepResult"),
      doc("compute_collision_free_stepsize#3"));
  m.def(
      "is_step_collision_free",
      [](const Mesh& mesh, const Trajectory& trajectory, const nb::kwargs& named) {
        return ask(mesh, trajectory, named, [](const Mesh& s, const Trajectory& t, const onset::Options& o) {
          return onset::is_step_collision_free(s, t, o);
        });
      },
      nb::arg("mesh"), nb::arg("trajectory"), nb::arg("options"),
      ONSET_TRAJECTORY_SIG("is_step_collision_free", "bool"), doc("is_step_collision_free#2"));
  m.def(
      "construct_active_set",
      [](const Mesh& mesh, const Trajectory& trajectory, const nb::kwargs& named) {
        return ask(mesh, trajectory, named, [](const Mesh& s, const Trajectory& t, const onset::Options& o) {
          return onset::construct_active_set(s, t, o);
        });
      },
      nb::arg("mesh"), nb::arg("trajectory"), nb::arg("options"),
      ONSET_TRAJECTORY_SIG("construct_active_set", "ActiveSet"), doc("construct_active_set#2"));
}

}  // namespace onset_python
