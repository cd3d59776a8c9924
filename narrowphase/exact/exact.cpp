#include "narrowphase/exact/exact.hpp"

#include <algorithm>

#include "narrowphase/exact/complete.hpp"
#include "narrowphase/exact/coplanar.hpp"
#include "narrowphase/exact/grid.hpp"
#include "narrowphase/exact/search.hpp"
#include "narrowphase/exact/static.hpp"

namespace onset {
namespace {

// Deeper searches are mostly degenerate, and the complete decision is then quicker.
constexpr int kDeepest = 24;

Grid grid_of(const ExactPair& pair) {
  Grid grid;
  for (const auto* points : {&pair.t0, &pair.t1})
    for (const double* p : *points) grid.add(p);
  return grid;
}

template <class C>
using IntegerPoints = std::array<std::array<C, 3>, 4>;

template <class C>
IntegerPoints<C> points_on_grid(const double* const (&points)[4], int last) {
  IntegerPoints<C> r;
  for (std::size_t i = 0; i < 4; ++i) r[i] = on_grid<C>(points[i], last);
  return r;
}

// For coordinates of q, a, b below 2^(bits + 1) (docs/theory.md, L37).
int cubic_bits_for(int bits) { return 3 * (bits + 1) + 5; }

// Returns how deep a search may go; below 0: it does not fit.
int depth_for(int bits, int width) {
  const int room = width - 2 - cubic_bits_for(bits);
  return room < 0 ? -1 : std::min(room / 3, kDeepest);
}

struct Decided {
  Answer answer;
  bool final;                         // wider integers would not know more
  std::optional<DoubleBracket> time;  // none: not known as precisely as was asked for
};

template <int Limbs, class C, class M, class T>
Decided search(const ExactPair& pair, const IntegerPoints<C>& t0, const IntegerPoints<C>& t1, int bits,
               int depth, bool want_time) {
  const int cubic_bits = cubic_bits_for(bits);
  const RelativeVectors<C> r0 = relative_vectors(pair.kind, t0), r1 = relative_vectors(pair.kind, t1);
  ExactSearch<Limbs, C, M, T> s(pair.kind, r0, r1, cubic_bits, depth);
  const ContactInterval found = s.first();
  if constexpr (sizeof(C) <= 16)
    if (found.coplanar) {
      const CoplanarContact first = first_coplanar_contact(pair.kind, r0, r1, want_time);
      return {first.answer, true, first.time};
    }
  if (found.answer != Answer::yes) return {found.answer, found.answer == Answer::no || found.zoomed, {}};
  const double width = std::ldexp(1.0, -found.depth), lo = double(found.k) * width;
  if (found.exact) return {found.answer, true, DoubleBracket{lo, lo}};
  if (!want_time) return {found.answer, true, DoubleBracket{lo, lo + width}};
  return {found.answer, true, bracket_of<Limbs>(s.cubic(), cubic_bits, found.k, found.depth)};
}

// Coordinates of up to 61 bits; first with a cubic of 128 bits where that is enough.
Decided search_narrow(const ExactPair& pair, const Grid& grid, bool want_time) {
  const auto t0 = points_on_grid<std::int64_t>(pair.t0, grid.last),
             t1 = points_on_grid<std::int64_t>(pair.t1, grid.last);
  const int shallow = depth_for(grid.bits(), 128);
  if (shallow >= 4) {
    const Decided r = search<8, std::int64_t, Int128, Int128>(pair, t0, t1, grid.bits(), shallow, want_time);
    if (r.final) return r;
  }
  return search<8, std::int64_t, Int128, Wide<4>>(pair, t0, t1, grid.bits(), depth_for(grid.bits(), 256),
                                                  want_time);
}

// Coordinates of up to 120 bits.
Decided search_two_limbs(const ExactPair& pair, const Grid& grid, bool want_time) {
  const auto t0 = points_on_grid<Wide<2>>(pair.t0, grid.last),
             t1 = points_on_grid<Wide<2>>(pair.t1, grid.last);
  return search<12, Wide<2>, Wide<4>, Wide<7>>(pair, t0, t1, grid.bits(), depth_for(grid.bits(), 64 * 7),
                                               want_time);
}

// Replaces the start by the positions at a time, and scales both to integers.
template <class W>
void start_at(const Dyadic& start, IntegerPoints<W>& t0, IntegerPoints<W>& t1) {
  const W one = shifted(W(1), start.exponent), passed(start.numerator);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t a = 0; a < 3; ++a) {
      t0[i][a] = t0[i][a] * (one - passed) + t1[i][a] * passed;
      t1[i][a] = t1[i][a] * one;
    }
}

constexpr int kWide = 8;
Decided search_wide(const ExactPair& pair, const Grid& grid, double from, bool want_time) {
  using W = Wide<kWide>;
  const Dyadic start = to_dyadic(from);
  const int bits = grid.bits() + start.exponent + 1, depth = depth_for(bits, 64 * kWide);
  if (depth < 4) return {Answer::unknown, true, {}};
  auto t0 = points_on_grid<W>(pair.t0, grid.last), t1 = points_on_grid<W>(pair.t1, grid.last);
  if (from > 0) start_at(start, t0, t1);
  return search<12, W, W, W>(pair, t0, t1, bits, depth, want_time);
}

// In the plane q x a is a quadratic, whose roots coplanar.cpp compares in integers of fixed width. C holds
// coordinates of q and a, M sums of two of their products.
template <class C, class M>
Decided search_in_plane(const ExactPair& pair, const IntegerPoints<C>& t0, const IntegerPoints<C>& t1,
                        bool want_time) {
  const RelativeVectors<C> r0 = relative_vectors(pair.kind, t0), r1 = relative_vectors(pair.kind, t1);
  if (on_segment<M>(PointAndSegment<C>{r0.q, r0.a})) return {Answer::yes, true, DoubleBracket{}};
  const CoplanarContact first = first_coplanar_contact(pair.kind, r0, r1, want_time);
  return {first.answer, true, first.time};
}

Decided search_in_plane(const ExactPair& pair, const Grid& grid, double from, bool want_time) {
  const Dyadic start = to_dyadic(from);
  if (from == 0 && grid.bits() <= 61)
    return search_in_plane<std::int64_t, Int128>(pair, points_on_grid<std::int64_t>(pair.t0, grid.last),
                                                 points_on_grid<std::int64_t>(pair.t1, grid.last), want_time);
  if (grid.bits() + start.exponent + 1 > 120) return {Answer::unknown, true, {}};
  auto t0 = points_on_grid<Wide<2>>(pair.t0, grid.last), t1 = points_on_grid<Wide<2>>(pair.t1, grid.last);
  if (from > 0) start_at(start, t0, t1);
  return search_in_plane<Wide<2>, Wide<4>>(pair, t0, t1, want_time);
}

Decided search(const ExactPair& pair, double from, bool want_time) {
  const Grid grid = grid_of(pair);
  if (pair.kind == PairKind::vertex_edge) return search_in_plane(pair, grid, from, want_time);
  if (from > 0 || grid.bits() > 120) return search_wide(pair, grid, from, want_time);
  return grid.bits() <= 61 ? search_narrow(pair, grid, want_time) : search_two_limbs(pair, grid, want_time);
}

}  // namespace

bool exactly_touches(const ExactPair& pair, double from) {
  const Decided r = search(pair, from, false);
  return r.answer == Answer::unknown ? completely_touches(pair, from) : r.answer == Answer::yes;
}

std::optional<DoubleBracket> exact_first_contact(const ExactPair& pair) {
  const Decided r = search(pair, 0, true);
  if (r.answer == Answer::no) return std::nullopt;
  if (r.answer == Answer::yes && r.time) return r.time;
  return complete_first_contact(pair);
}

ExactAnswer exact_answer(const ExactPair& pair, Effort effort) {
  const Decided r = search(pair, 0, false);
  if (r.answer == Answer::yes) return {r.answer, *r.time};
  if (r.answer == Answer::no || effort == Effort::quick) return {r.answer, {}};
  const auto time = complete_first_contact(pair, false);
  return time ? ExactAnswer{Answer::yes, *time} : ExactAnswer{Answer::no, {}};
}

}  // namespace onset
