// What a caller gets wrong is an std::invalid_argument that says what and by how much.
#include <functional>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::set_rule;

namespace {

// The message, or what happened instead.
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& e) {
    return e.what();
  } catch (...) {
    return "another exception";
  }
  return "no exception";
}

bool names(const std::string& message, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (message.find(word) == std::string::npos) return false;
  return message != "no exception" && message != "another exception";
}

struct Calls {
  scenes::Scene scene = scenes::cube();
  Mesh mesh{scene.x_t0, scene.faces};

  std::vector<std::function<void()>> with(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                          const Options& o = {}) const {
    return {[=, m = mesh] { compute_collision_free_stepsize(m, a, b, o); },
            [=, m = mesh] { construct_active_set(m, a, b, o); },
            [=, m = mesh] { is_step_collision_free(m, a, b, o); },
            [=, m = mesh] { compute_candidates(m, a, b, o); }};
  }
};

void expect(const std::vector<std::function<void()>>& calls, std::initializer_list<const char*> words) {
  for (const auto& call : calls) {
    const std::string message = message_of(call);
    INFO(message);
    CHECK(names(message, words));
  }
}

void expect_rejected(const Options& o, std::initializer_list<const char*> words) {
  const Calls c;
  auto calls = c.with(c.scene.x_t0, c.scene.x_t1, o);
  calls.push_back([=] { vertex_face_ccd(VertexFaceQuery{}, o); });
  calls.push_back([=] { edge_edge_ccd(EdgeEdgeQuery{}, o); });
  expect(calls, words);
}

}  // namespace

TEST_CASE("wrong numbers of rows and columns are named", "[unit]") {
  const Calls c;
  const Eigen::MatrixXd good = c.scene.x_t0;
  expect(c.with(Eigen::MatrixXd::Zero(7, 3), good), {"x_t0", "7", "8"});
  expect(c.with(good, Eigen::MatrixXd::Zero(9, 3)), {"x_t1", "9", "8"});
  expect(c.with(Eigen::MatrixXd::Zero(8, 2), good), {"x_t0", "2"});
  expect(c.with(Eigen::MatrixXd::Zero(3, 8), good), {"x_t0", "3"});
  expect(c.with(good, Eigen::MatrixXd::Zero(0, 3)), {"x_t1", "0", "8"});
  expect(c.with(good, Eigen::VectorXd::Zero(25)), {"x_t1"});
  expect(c.with(good, Eigen::VectorXd::Zero(27)), {"x_t1", "9", "8"});
}

// What a caller has who keeps one vertex a column.
TEST_CASE("positions of one column a vertex are told what to pass instead", "[unit]") {
  const Calls c;
  const Eigen::MatrixXd good = c.scene.x_t0, columns = good.transpose();
  expect(c.with(columns, good), {"x_t0", "transpose()", "data()"});
  expect(c.with(good, columns), {"x_t1", "transpose()", "data()"});
  const StepResult still =
      compute_collision_free_stepsize(c.mesh, columns.transpose(), Positions(columns.data(), 8));
  CHECK(still.step == 1);
}

TEST_CASE("options out of range are named with their value", "[unit]") {
  for (double bad : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    Options o;
    o.tolerance = bad;
    expect_rejected(o, {"tolerance", bad > 0 ? "inf" : bad == 0 ? "0" : bad < 0 ? "-1" : "nan"});
    Options r;
    r.relative_tolerance = bad;
    expect_rejected(r, {"relative_tolerance"});
  }
  for (double bad : {-1e-300, -1.0, double(NAN), double(INFINITY), -double(INFINITY)}) {
    Options o;
    o.min_separation = bad;
    expect_rejected(o, {"min_separation"});
  }
  for (std::int64_t bad : {std::int64_t(0), std::int64_t(-5)}) {
    Options o;
    o.max_checks = bad;
    expect_rejected(o, {"max_checks", bad == 0 ? "0" : "-5"});
  }
  Options o;
  o.threads = -2;
  expect_rejected(o, {"threads", "-2"});
}

TEST_CASE("the ends of the options' ranges are accepted", "[unit]") {
  const Calls c;
  Options o;
  o.tolerance = 0x1p-1074;
  o.max_checks = 1;
  o.min_separation = 0;
  for (const auto& call : c.with(c.scene.x_t0, c.scene.x_t1, o)) CHECK_NOTHROW(call());
  o.tolerance = 0x1p1000;
  o.min_separation = 0x1p1000;
  o.max_checks = std::numeric_limits<std::int64_t>::max();
  o.relative_tolerance = 1e300;
  o.threads = 1;
  for (const auto& call : c.with(c.scene.x_t0, c.scene.x_t1, o)) CHECK_NOTHROW(call());
}

TEST_CASE("the tolerance that a call says it had is one that a call takes", "[unit]") {
  const Calls c;
  for (const double relative : {1e-320, 1e-6, 1e300, 1e308, std::numeric_limits<double>::max()})
    for (const double size : {1e-300, 1.0, 1e300}) {
      const Eigen::MatrixXd x_t0 = size * c.scene.x_t0, x_t1 = size * c.scene.x_t1;
      Options o;
      o.relative_tolerance = relative;
      const StepResult r = compute_collision_free_stepsize(c.mesh, x_t0, x_t1, o);
      CAPTURE(relative, size, r.stats.tolerance);
      o.tolerance = r.stats.tolerance;
      StepResult again;
      CHECK_NOTHROW(again = compute_collision_free_stepsize(c.mesh, x_t0, x_t1, o));
      CHECK((again.step == r.step && again.stats.tolerance == r.stats.tolerance));
    }
}

TEST_CASE("bad topology is named by its row", "[unit]") {
  const Eigen::MatrixXd x = Eigen::MatrixXd::Zero(4, 3);
  Eigen::MatrixXi F(2, 3), E(2, 2);
  F << 0, 1, 2, 1, 2, 4;
  CHECK(names(message_of([&] { Mesh(x, F); }), {"face", "row 1", "4"}));
  F << 0, 1, 2, 1, -1, 2;
  CHECK(names(message_of([&] { Mesh(x, F); }), {"face", "row 1", "-1"}));
  F << 0, 1, 1, 1, 2, 3;
  CHECK(names(message_of([&] { Mesh(x, F); }), {"face", "row 0", "repeated"}));
  F << 0, 1, 2, 1, 2, 3;
  E << 0, 1, 2, 2;
  CHECK(names(message_of([&] { Mesh(x, E, F); }), {"edge", "row 1", "repeated"}));
  E << 0, 1, 2, 3;
  CHECK(names(message_of([&] { Mesh(x, E, Eigen::MatrixXi::Zero(2, 4)); }), {"face", "4"}));
  CHECK(names(message_of([&] { Mesh(x, F, F); }), {"edge", "3"}));
  for (const std::ptrdiff_t count : {std::ptrdiff_t(-1), std::ptrdiff_t(1) << 31})
    CHECK(message_of([&] { Mesh(count, F); }) == "a mesh cannot have " + std::to_string(count) + " vertices");
}

TEST_CASE("bad thickness is named by its row", "[unit]") {
  Calls c;
  const auto thick = [&](const std::vector<double>& t) {
    return message_of([&] { set_rule(c.mesh, &CollisionRules::thickness, t); });
  };
  CHECK(names(thick({1, 2}), {"thickness", "2", "8"}));
  std::vector<double> t(8, 0.1);
  for (double bad : {-0.5, double(NAN), double(INFINITY), 1e308}) {
    t[5] = bad;
    CHECK(names(thick(t), {"thickness", "row 5"}));
  }
}

TEST_CASE("positions of too few columns are not read past, and options out of their enumerators are named",
          "[unit]") {
  Calls c;
  const Eigen::MatrixXd thin = Eigen::MatrixXd::Zero(8, 2), dx = Eigen::MatrixXd::Zero(8, 3);
  CHECK(names(message_of([&] { LineSearch(c.mesh, thin, dx); }), {"x_t0", "8", "2"}));
  CHECK(names(message_of([&] { LineSearch(c.mesh, dx, thin); }), {"dx", "8", "2"}));
  CHECK(names(message_of([&] { edge_list(Eigen::MatrixXi::Zero(2, 4)); }), {"faces", "4"}));
  const auto with = [&](auto set) {
    Options options;
    set(options);
    return message_of([&] { construct_active_set(c.mesh, dx, dx, options); });
  };
  CHECK(names(with([](Options& o) { o.norm = Norm(9); }), {"norm", "9"}));
  CHECK(names(with([](Options& o) { o.broad_phase = BroadPhaseMethod(9); }), {"broad_phase", "9"}));
  CHECK(names(with([](Options& o) { o.narrow_phase = NarrowPhaseMethod(9); }), {"narrow_phase", "9"}));
  CHECK(names(with([](Options& o) { o.exactness = Exactness(9); }), {"exactness", "9"}));
  CHECK(names(with([](Options& o) { o.threads = 2147483647; }), {"threads", "2147483647"}));
}
