// What is said not to throw, as the compiler sees it. That it does not even where memory runs out is tested
// with all other calls (test_failing_allocations.cpp).
#include <onset/onset.hpp>
#include <type_traits>
#include <utility>

using namespace onset;

namespace {

template <class... T>
constexpr bool all_move =
    (... && (std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T>));

// Results, options and rules go from hand to hand without a copy.
static_assert(all_move<Mesh, LineSearch, Options, LineSearchOptions, CollisionRules, Positions, Indices>);
static_assert(all_move<StepResult, LineSearchStep, ActiveSet, Candidates, ClosePairs, Constraints,
                       Intersections, StartReport, StartFinding, QueryResult, Contact, Stats>);
static_assert(std::is_nothrow_copy_constructible_v<Mesh> && std::is_nothrow_copy_assignable_v<Mesh>);
static_assert(std::is_nothrow_default_constructible_v<LineSearch>);
static_assert(!std::is_copy_constructible_v<LineSearch>);

template <class... Enum>
constexpr bool all_have_names = (...&& noexcept(to_string(Enum())));
static_assert(all_have_names<PairKind, PairOutcome, Outcome, Certainty, IntersectionKind, StartFault>);

// Never called: what it asks for is looked at, not done.
[[maybe_unused]] void quiet(const Mesh& mesh, const Positions& x, const ActiveSet& set,
                            const Intersections& crossings, const StartReport& report,
                            const PairCounts& counts, const QueryResult& query) {
  static_assert(noexcept(mesh.num_vertices())&& noexcept(mesh.num_edges())&& noexcept(mesh.num_faces()));
  static_assert(noexcept(mesh.num_points())&& noexcept(mesh.num_bodies())&& noexcept(mesh.rules()));
  static_assert(noexcept(mesh.num_full_vertices())&& noexcept(mesh.filter_counts()));
  static_assert(noexcept(mesh.release_memory()));
  static_assert(
      noexcept(Positions(nullptr, 0))&& noexcept(x(0, 0))&& noexcept(x.rows())&& noexcept(x.cols()));
  static_assert(noexcept(set.earliest())&& noexcept(set.size()));
  static_assert(noexcept(crossings.count(IntersectionKind())));
  static_assert(noexcept(report.acceptable())&& noexcept(report.clean()));
  static_assert(noexcept(counts.total())&& noexcept(query.collides()));
  // Those that throw where a row does not exist.
  static_assert(!noexcept(mesh.edge(0)) && !noexcept(mesh.components()));
}
}  // namespace
