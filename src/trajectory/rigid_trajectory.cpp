#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/float_environment.hpp"
#include "base/text_stream.hpp"
#include "onset/trajectory.hpp"
#include "scene/motion/rotation.hpp"
#include "scene/motion/storing.hpp"

namespace onset {
namespace {

constexpr double kLongestRotation = 0x1p20;

struct Body {
  Turn turn;
  bool turns;  // else it is linear
  bool finite;
};

std::vector<double> copied(const char* name, const Positions& x, std::ptrdiff_t rows) {
  if (x.cols() != 3 || x.rows() != rows)
    throw std::invalid_argument(std::string(name) + " has " + std::to_string(x.rows()) + " rows of " +
                                std::to_string(x.cols()) + " coordinates, not " + std::to_string(rows) +
                                " of 3");
  std::vector<double> r;
  r.reserve(std::size_t(3 * rows));
  for (std::ptrdiff_t v = 0; v < rows; ++v)
    for (std::ptrdiff_t a = 0; a < 3; ++a) r.push_back(x(v, a));
  return r;
}

Body body_of(const double* rotation, const double* translation, const double* centre) {
  Body body{};
  body.finite = true;
  for (int a = 0; a < 3; ++a) {
    body.finite = body.finite && std::isfinite(rotation[a]) && std::isfinite(translation[a]) &&
                  std::isfinite(centre[a]);
    body.turns = body.turns || rotation[a] != 0;
  }
  if (!body.finite) {
    body.turns = false;
    return body;
  }
  if (body.turns) body.turn = make_turn(rotation, translation, centre);
  if (body.turns && !(body.turn.angle <= kLongestRotation)) {
    TextStream s;
    s << "rotation turns by " << body.turn.angle << "; at most 2^20 radians are supported";
    throw std::invalid_argument(s.str());
  }
  return body;
}

}  // namespace

struct RigidTrajectory::Impl {
  std::vector<double> x0, x1;  // 3 #V
  std::vector<int> body;       // of each vertex; -1: none
  std::vector<Body> bodies;

  bool turns(std::size_t v) const { return body[v] >= 0 && bodies[std::size_t(body[v])].turns; }
  int add(const std::vector<int>& vertices, const double* rotation, const double* translation,
          const double* centre);
  void positions(double t, const int* vertices, std::size_t count, double* xyz) const;
  void straying(double t0, double t1, const int* vertices, std::size_t count, double* bounds) const;
};

Trajectory::~Trajectory() = default;

void Trajectory::all_positions(double t, double* xyz) const {
  std::vector<int> all(static_cast<std::size_t>(num_vertices()));
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = int(v);
  in_float_environment([&] { positions(t, all.data(), all.size(), xyz); });
}

RigidTrajectory::RigidTrajectory(const Positions& x_t0, const Positions& x_t1)
    : impl_(new Impl{copied("x_t0", x_t0, x_t0.rows()), copied("x_t1", x_t1, x_t0.rows()), {}, {}}) {
  impl_->body.assign(std::size_t(x_t0.rows()), -1);
}
RigidTrajectory::RigidTrajectory(const Positions& x_t0) : RigidTrajectory(x_t0, x_t0) {}
RigidTrajectory::RigidTrajectory(const RigidTrajectory& other)
    : Trajectory(other), impl_(new Impl(*other.impl_)) {}
RigidTrajectory& RigidTrajectory::operator=(const RigidTrajectory& other) {
  if (this != &other) impl_.reset(new Impl(*other.impl_));
  return *this;
}
RigidTrajectory::RigidTrajectory(RigidTrajectory&&) noexcept = default;
RigidTrajectory& RigidTrajectory::operator=(RigidTrajectory&&) noexcept = default;
RigidTrajectory::~RigidTrajectory() = default;

// A body that does not turn is linear: its x1 says how.
int RigidTrajectory::Impl::add(const std::vector<int>& vertices, const double* rotation,
                               const double* translation, const double* centre) {
  const Body added = body_of(rotation, translation, centre);
  std::vector<int> changed = body;
  const int id = int(bodies.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const int v = vertices[i];
    if (v < 0 || std::size_t(v) >= body.size())
      throw std::invalid_argument("vertices row " + std::to_string(i) + ": vertex " + std::to_string(v) +
                                  " is out of range, there are " + std::to_string(body.size()));
    if (changed[std::size_t(v)] >= 0)
      throw std::invalid_argument("vertices row " + std::to_string(i) + ": vertex " + std::to_string(v) +
                                  " is in body " + std::to_string(changed[std::size_t(v)]) + " already");
    changed[std::size_t(v)] = id;
  }
  bodies.push_back(added);
  body.swap(changed);
  for (const int v : vertices)
    for (int a = 0; a < 3; ++a) {
      double& end = x1[3 * std::size_t(v) + std::size_t(a)];
      end = added.finite ? x0[3 * std::size_t(v) + std::size_t(a)] + translation[a] : NAN;
    }
  return id;
}

int RigidTrajectory::add(const std::vector<int>& vertices, const double* rotation, const double* translation,
                         const double* centre) {
  const FloatEnvironment environment;
  return impl_->add(vertices, rotation, translation, centre);
}

int RigidTrajectory::add(std::ptrdiff_t first, std::ptrdiff_t last, const double* rotation,
                         const double* translation, const double* centre) {
  if (first < 0 || last < first || last > num_vertices())
    throw std::invalid_argument("vertices [" + std::to_string(first) + ", " + std::to_string(last) +
                                ") are out of range, there are " + std::to_string(num_vertices()));
  std::vector<int> vertices;
  for (std::ptrdiff_t v = first; v < last; ++v) vertices.push_back(int(v));
  return add(vertices, rotation, translation, centre);
}

std::ptrdiff_t RigidTrajectory::num_vertices() const { return std::ptrdiff_t(impl_->body.size()); }
int RigidTrajectory::body(std::ptrdiff_t vertex) const {
  return impl_->turns(std::size_t(vertex)) ? impl_->body[std::size_t(vertex)] : kLinear;
}

void RigidTrajectory::Impl::positions(double t, const int* vertices, std::size_t count, double* xyz) const {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t v = std::size_t(vertices[i]);
    if (turns(v) && t != 0)
      turn(bodies[std::size_t(body[v])].turn, t, &x0[3 * v], xyz + 3 * i);
    else
      for (std::size_t a = 0; a < 3; ++a)
        xyz[3 * i + a] = stored_between(x0[3 * v + a], turns(v) ? x0[3 * v + a] : x1[3 * v + a], t);
  }
}

// Twice the rounding: of the chord's ends, and of what is stored on the way.
void RigidTrajectory::Impl::straying(double t0, double t1, const int* vertices, std::size_t count,
                                     double* bounds) const {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t v = std::size_t(vertices[i]);
    bounds[i] = 0;
    if (!turns(v)) continue;
    const Turn& turn = bodies[std::size_t(body[v])].turn;
    const Orbit orbit = orbit_of(turn, &x0[3 * v]);
    bounds[i] =
        (straying_of_turn(turn, orbit, t0, t1) + 2 * rounding_of_turn(turn, orbit, t1)) * (1 + 0x1p-50);
  }
}

void RigidTrajectory::positions(double t, const int* vertices, std::size_t count, double* xyz) const {
  in_float_environment([&] { impl_->positions(t, vertices, count, xyz); });
}
void RigidTrajectory::straying(double t0, double t1, const int* vertices, std::size_t count,
                               double* bounds) const {
  in_float_environment([&] { impl_->straying(t0, t1, vertices, count, bounds); });
}

}  // namespace onset
