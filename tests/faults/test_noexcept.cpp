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

static_assert(
    noexcept(to_string(PairKind())) && noexcept(to_string(PairOutcome())) && noexcept(to_string(Outcome())) && noexcept(
        to_string(
            Certainty())) && noexcept(to_string(IntersectionKind())) && noexcept(to_string(StartFault())));
static_assert(noexcept(std::declval<const Mesh&>().num_vertices()) && noexcept(std::declval<const Mesh&>().num_edges()) && noexcept(
    std::declval<const Mesh&>()
        .num_faces()) && noexcept(std::declval<const Mesh&>()
                                      .num_points()) && noexcept(std::declval<const Mesh&>()
                                                                     .num_bodies()) && noexcept(std::declval<const Mesh&>()
                                                                                                    .num_full_vertices()) && noexcept(std::declval<const Mesh&>()
                                                                                                                                          .rules()) && noexcept(std::declval<const Mesh&>()
                                                                                                                                                                    .filter_counts()) && noexcept(std::
                                                                                                                                                                                                      declval<
                                                                                                                                                                                                          const Mesh&>()
                                                                                                                                                                                                          .release_memory()));
static_assert(noexcept(std::declval<const Positions&>()(0, 0)) && noexcept(
    std::declval<const Positions&>().rows()) && noexcept(std::declval<const Positions&>()
                                                             .cols()) && noexcept(Positions(nullptr, 0)));
static_assert(noexcept(std::declval<ActiveSet>().earliest()) && noexcept(std::declval<ActiveSet>().size()) && noexcept(
    std::declval<Intersections>().count(
        IntersectionKind())) && noexcept(std::declval<StartReport>()
                                             .acceptable()) && noexcept(std::declval<StartReport>()
                                                                            .clean()) && noexcept(std::declval<PairCounts>()
                                                                                                      .total()) && noexcept(std::declval<QueryResult>()
                                                                                                                                .collides()));
// Those that throw by design.
static_assert(!noexcept(std::declval<const Mesh&>().edge(0)) &&
              !noexcept(std::declval<const Mesh&>().components()));

}  // namespace
