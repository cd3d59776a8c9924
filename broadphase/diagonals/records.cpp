#include "broadphase/diagonals/records.hpp"

#include <algorithm>
#include <cmath>

#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "broadphase/diagonals.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 2048;

}  // namespace

void DiagonalRecords::write(const BroadPhaseInput& input, double t_max, const LinearMap& by, const int* ids,
                            std::size_t count, std::size_t size, bool by_id, const Stop& stop) {
  const std::size_t floats = size * std::size_t(kDiagonalStride);
  if (records.size() < floats) records = AlignedArray<float>(floats);
  map = by;
  thinnest = thickest = 0;
  if (const std::vector<double>& thickness = input.mesh.thickness; !thickness.empty()) {
    const auto [least, most] = std::minmax_element(thickness.begin(), thickness.end());
    thinnest = *least, thickest = *most;
  }
  const DiagonalArguments arguments{map, input.motion.x.data(), ids, t_max, by_id, records.data()};
  auto* kernel = &diagonals_scalar::write_records;
#ifdef ONSET_HAVE_AVX2
  if (runs_avx2(resolve_instruction_set(input.instruction_set))) kernel = &diagonals_avx2::write_records;
#endif
  range = parallel_reduce(
      count, kGrain, DiagonalRange{},
      [&](std::size_t first, std::size_t last) {
        return stop.requested() ? DiagonalRange{} : kernel(arguments, first, last);
      },
      [](const DiagonalRange& x, const DiagonalRange& y) {
        return DiagonalRange{std::max(x.largest, y.largest), x.far_out || y.far_out};
      });
}

// In the unit of the map, let M <= 64 be the largest magnitude of a vertex that is not far out, and C that
// of the centre. A place is rounded to float once, by 2^-24 M, and once more is the difference of two, of up
// to 2M: 2^-22 M together. Roundings in double, of places and of the definition, are below 2^-39. With t_max
// < 1 ends are intervals, and a coordinate there is within 2^-50 (C + 2^12) of any value that it has here or
// in the definition: 2^-44 (C + 2^12) covers 12 of them (docs/theory.md, L53).
DiagonalLimits diagonal_limits(const BroadPhaseInput& input, double inflations, const DiagonalRecords& a,
                               const DiagonalRecords& b) {
  const double largest = std::max(a.range.largest, b.range.largest);
  double error = 0x1p-22 * (1 + 0x1p-10) * largest + 0x1p-36;
  if (input.t_max != 1) {
    double offset = 0;
    for (const double c : a.map.centre) offset += std::fabs(c) * a.map.scale;
    error += 0x1p-44 * (offset + kFarthestEnd);
  }
  const double least = 2 * std::min(a.thinnest, b.thinnest), most = 2 * std::max(a.thickest, b.thickest);
  DiagonalLimits limits{};
  constexpr double kDown = 1 - 0x1p-22, kUp = 1 + 0x1p-22;  // also for the rounding to float
  for (int k = 0; k < kDiagonals; ++k) {
    const double unit = diagonal_reach(input.diagonals.norm) * a.map.scale, margin = input.diagonals.margin;
    limits.apart[k] = float(std::min(((inflations + most + margin) * unit + error) * kUp, 0x1p120));
    limits.together[k] = float(std::min((inflations + least + margin) * unit * kDown - error * kUp, 0x1p120));
  }
  limits.far_out = a.range.far_out || b.range.far_out;
  return limits;
}

}  // namespace onset
