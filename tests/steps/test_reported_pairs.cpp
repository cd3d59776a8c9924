// Single pairs that were answered wrongly once, each asked through every call.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/scenes/families.hpp"
#include "tests/src/support/one_pair.hpp"
#include "tests/steps/support/promises.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;

namespace {

constexpr PairKind kVertexFace = PairKind::vertex_face, kEdgeEdge = PairKind::edge_edge;

void check_all_calls(const Query& query, Options options = {}) {
  const Elements elements = elements_of(query.kind);
  const StepScene scene{positions(query.t0), positions(query.t1), elements.edges, elements.faces};
  const Calls calls(scene);
  INFO(to_text(query));
  for (Exactness level : {Exactness::conservative, Exactness::certify, Exactness::exact}) {
    options.exactness = level;
    const Asked asked{calls.mesh(), scene.x_t0, scene.x_t1, options, {}};
    const oracle::Truth truth = oracle::exact_within(query, options.min_separation, options.norm);
    const QueryResult alone = scenes::ccd(query, options);
    INFO("certainty " << int(level) << ": " << oracle::to_text(options, alone));
    for (double d_hat : {0x1p-4, 16.0})
      CHECK(broken_promise(asked, calls, d_hat * oracle::extent(query)) == "");
    CHECK(oracle::broken_promise(query, options, alone, oracle::known(truth)) == "");
    CHECK(oracle::wrong_report(query, options, alone) == "");
  }
}

void check_time(const Query& query, double first, const Options& options = {}) {
  CHECK(oracle::exact_within(query, options.min_separation, options.norm).toi_lo == first);
}

// A vertex over a triangle of that size in the plane z = 0, from `from` to `to`.
Query over_a_floor(double size, Point from, Point to) {
  const Point f0{-size, -size, 0}, f1{size, -size, 0}, f2{0, size, 0};
  return {kVertexFace, {{from, f0, f1, f2}}, {{to, f0, f1, f2}}};
}

Options with_tolerance(double tolerance) {
  Options options;
  options.tolerance = tolerance;
  return options;
}
Options with_relative_tolerance(double tolerance) {
  Options options;
  options.relative_tolerance = tolerance;
  return options;
}

}  // namespace

TEST_CASE("a vertex through a floor is not lost below what doubles resolve", "[oracle][regression]") {
  const Query integers = over_a_floor(2, {0, 0, 1}, {0, 0, -2});
  check_time(integers, 1 / 3.0);
  check_all_calls(integers, with_relative_tolerance(1e-15));
  check_all_calls(integers, with_relative_tolerance(1e-300));
  check_all_calls(integers, with_tolerance(1e-300));
  const Query large = over_a_floor(1e5, {0, 0, 1000}, {0, 0, -2000});
  check_all_calls(large, with_tolerance(1e-10));
  Options first = with_tolerance(1e-10);
  first.window = 0;
  check_all_calls(large, first);
  const Query general{kVertexFace,
                      {{{-2, -2, 0}, {1, 1, 1}, {1, -1, 0}, {0, -2, 1}}},
                      {{{2, 1, 2}, {-1, 1, -2}, {-1, 0, 2}, {0, 2, 1}}}};
  check_time(general, 0.5);
  check_all_calls(general, with_relative_tolerance(1e-15));
}

TEST_CASE("a contact whose checks are spent is not lost by the step", "[oracle][regression]") {
  const Query query{kVertexFace,
                    {{{-0x1.1a594abc50195p-2, -0x1.2586c51d18303p-8, 0x1.a887ef0938221p-2},
                      {-0x1.8615d97a29f2cp-2, 0x1.49e820b7c39p-2, 0x1.1b5258fe80af2p-1},
                      {-0x1.4294f04aaf8f2p-1, 0x1.877d8c38b41a4p-2, 0x1.945ea69f1cc9p-4},
                      {0x1.a689ed9e7f7dp-2, 0x1.b0bc7d3cd8ea8p-3, -0x1.118b79750071p-4}}},
                    {{{-0x1.d0572d49cd1cbp-1, 0x1.d6be5baa2d77cp+0, 0x1.b3e09ae4a0e4cp+0},
                      {-0x1.9bdf1c99bebap-5, -0x1.a43e64ed07e7ap-1, 0x1.25361904e8362p-1},
                      {0x1.aeeefd0258bb2p-1, -0x1.95273acbfb1ep-1, 0x1.36640795a94f8p-3},
                      {0x1.7b2e962da4f74p-1, 0x1.cf0c2bcf02e94p-1, 0x1.d9c62f97aaep-4}}}};
  Options options;
  options.narrow_phase = NarrowPhaseMethod::inclusion;
  options.min_separation = 0.001;
  options.norm = Norm::maximum;
  CHECK(oracle::exact_ccd(query).toi_lo == 0.10938457593691374);
  CHECK(oracle::exact_within(query, options.min_separation, options.norm).toi_lo < 0.1091);
  for (std::int64_t checks : {1000, 100, 10, 1}) {
    options.max_checks = checks;
    check_all_calls(query, options);
  }
}

TEST_CASE("what lands exactly at the end of the step is a contact", "[oracle][regression]") {
  const auto landing = [](double from) {
    const Point f0{0, 0, 0}, f1{1, 0, 0}, f2{0, 1, 0};
    return Query{kVertexFace, {{{0.25, 0.25, from}, f0, f1, f2}}, {{{0.25, 0.25, 0}, f0, f1, f2}}};
  };
  for (double from : {1.0, 0x1p-20, 0x1p-55, 0x1p-300, 0x1p-1074}) {
    check_time(landing(from), 1);
    check_all_calls(landing(from));
  }
}

TEST_CASE("what starts beyond the separation does not end within it", "[oracle][regression]") {
  const Query query{kEdgeEdge,
                    {{{-0x1.bdf31d2f9f562p-1, -0x1.8939005e45694p-1, 0x1.fd587d36fb75ep-1},
                      {-0x1.9ce0fc17e6d2p-5, -0x1.87f00497c5009p+0, 0x1.6934760863b5p-1},
                      {-0x1.1cd403270b99dp-1, -0x1.0f845f26fea8cp+0, 0x1.c488fc9f105e3p-1},
                      {-0x1.aa42070f3a69p-1, -0x1.9b8842bc5b598p-1, 0x1.f6670aa692b3bp-1}}},
                    {{{-0x1.bdf31d2fa01eep-1, -0x1.8939005e46529p-1, 0x1.fd587d36fadd7p-1},
                      {-0x1.9ce0fc17f44e9p-5, -0x1.87f00497c5acep+0, 0x1.69347608630f2p-1},
                      {-0x1.1cd403270b8f5p-1, -0x1.0f845f26feaddp+0, 0x1.c488fc9f1053ap-1},
                      {-0x1.aa42070f3a366p-1, -0x1.9b8842bc5bb1fp-1, 0x1.f6670aa692c02p-1}}}};
  Options options;
  options.min_separation = 0x1.3ecc5bdafd81ep-41;
  check_all_calls(query, options);
  CHECK_FALSE(is_step_collision_free(mesh_of(kEdgeEdge), positions(query.t0), positions(query.t1), options));
}

TEST_CASE("what starts beyond the separation and never comes within it goes on", "[oracle][regression]") {
  const Query query{kVertexFace,
                    {{{-0x1.6a11dde53ca5ep-4, -0x1.00e5b58c37195p-1, 0x1.db35b650d0e2bp-2},
                      {0x1.67e34f1ff94b9p-5, -0x1.917f7bbbe2314p-2, 0x1.0e9e61fd7cc33p-4},
                      {0x1.63baaf89c656p-4, -0x1.6d13fc77c1e2cp-2, -0x1.0217b479dcbdp-4},
                      {-0x1.e91b8878a227p-3, -0x1.40b99ce3d6b44p-1, 0x1.d540d5c976dbcp-1}}},
                    {{{-0x1.7d91a697d19fcp-4, -0x1.02e40fde999bdp-1, 0x1.dfd54517eca44p-2},
                      {0x1.15054c6d70a47p-5, -0x1.990bad9c4a322p-2, 0x1.39a716faa4035p-4},
                      {0x1.44e8dff60af2cp-4, -0x1.65058dd4d11cdp-2, -0x1.f1710c1c51fep-5},
                      {-0x1.e235bfe67648ap-3, -0x1.4636ec904a6ecp-1, 0x1.d58edd1e2050bp-1}}}};
  Options options;
  options.min_separation = 0x1.3c4db7c0f18e9p-33;
  check_all_calls(query, options);
  CHECK(scenes::ccd(query, options).toi > 0);
}

TEST_CASE("a gap whose foot ties with a corner keeps its share", "[oracle][regression]") {
  const Point f0{0, 0, 0}, f1{1, 0, 0x1.363ef9571ce85p-27}, f2{0, 0, -1};
  const double height = 0x1.365deaf95836fp-27;
  const Query query{kVertexFace, {{{0, 0, height}, f0, f1, f2}}, {{{0, 0, -height}, f0, f1, f2}}};
  check_all_calls(query, with_tolerance(1));  // half of the gap is within its reach
  const Eigen::MatrixXd x = positions(query.t0), dx = positions(query.t1) - x;
  const LineSearchStep r = LineSearch(mesh_of(kVertexFace), x, dx, with_share({}, 0.5)).largest_step();
  CHECK_FALSE(r.gap_share_reduced);
  const Query there{kVertexFace, {{{0, 0, height + r.step * dx(0, 2)}, f0, f1, f2}}, {}};
  CHECK(oracle::compare_distance(there, 0, 0.5 * oracle::distance(query, 0).lo * (1 - 0x1p-20)) >= 0);
}

TEST_CASE("what touches, parts and crosses at once does not cross", "[oracle][regression]") {
  const Query query{kVertexFace,
                    {{{-0x1.f3312baea5c52p-2, 0x1.9290cc789962bp-4, -0x1.a84ad34701fdap-2},
                      {0x1.25dbd42a918p-11, -0x1.8eb89c5bfd3aep-1, -0x1.8119e74ba758p-5},
                      {-0x1.64b0522ee8aeap-1, 0x1.e588cf0c3478p-2, -0x1.24c02e6e68668p-1},
                      {-0x1.f3312baea5c52p-2, 0x1.9290cc789962bp-4, -0x1.a84ad34701fdap-2}}},
                    {{{0x1.8a8e145cc567p-1, -0x1.38b6c37b4913ep-1, -0x1.734e718630d7ep-1},
                      {-0x1.11c70f329613p-1, 0x1.cab49fcd363e8p-2, 0x1.80cb693236ba2p-1},
                      {-0x1.0fb903cd41e26p-1, 0x1.491826163fd4p-4, -0x1.f5a12672d0b1cp-2},
                      {0x1.54e855ac419c6p-1, -0x1.abbfe24de518ep-1, -0x1.7c74e05327292p-1}}}};
  CHECK(oracle::exact_ccd_after_start(query).toi_lo < 1e-13);
  check_all_calls(query);
  CHECK(scenes::ccd(query).step_limit == 0);
}

TEST_CASE("a touching pair that parts again blocks the step and is told", "[oracle][regression]") {
  const Query parting = over_a_floor(2, {0, 0, 0}, {0, 0, 1}),
              at_rest = over_a_floor(2, {0, 0, 0}, {0, 0, 0});
  for (const Query& query : {parting, at_rest}) {
    check_all_calls(query);
    const Mesh mesh = mesh_of(kVertexFace);
    CHECK_FALSE(is_step_collision_free(mesh, positions(query.t0), positions(query.t1)));
  }
}

TEST_CASE("a height of one subnormal number over a face is kept, or the step is 0", "[oracle][regression]") {
  for (double eta : {0x1p-1074, 0x1p-1072, 0x1p-1040}) {
    const Point f0{0, 0, 0}, f1{16 * eta, 0, 0}, f2{0, 16 * eta, 0};
    const auto falling = [&](double from, double to) {
      return Query{kVertexFace,
                   {{{2 * eta, 2 * eta, from * eta}, f0, f1, f2}},
                   {{{2 * eta, 2 * eta, to * eta}, f0, f1, f2}}};
    };
    for (double from : {1.0, 3.0, 7.0})
      for (double to : {-1.0, 0.0, 1.0, -5.0}) check_all_calls(falling(from, to));
  }
}
