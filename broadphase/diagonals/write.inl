// Kernel text that makes the records of vertices along diagonals.
#pragma once

#include "base/simd/pack.hpp"
#include "broadphase/diagonals/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// Four vertices, one a lane, through the map.
struct FourMapped {
  D4 x, y, z;

  D4 magnitude() const { return abs(x) + abs(y) + abs(z); }
  // In the order of kDiagonal.
  D4 along(int diagonal) const {
    switch (diagonal % 6) {
      case 0:
        return x + y;
      case 1:
        return x - y;
      case 2:
        return x + z;
      case 3:
        return x - z;
      case 4:
        return y + z;
      default:
        return y - z;
    }
  }
};

template <bool kStopped>
class DiagonalWriter {
 public:
  explicit DiagonalWriter(const DiagonalArguments& a) : a_(a) {}

  // Writes the records of the vertices ids[first..first + count), at most eight.
  void write(std::size_t first, std::size_t count) {
    const double* rows[8];
    float* out[8];
    for (std::size_t l = 0; l < 8; ++l) {
      const std::size_t i = first + (l < count ? l : 0);
      const std::size_t id = std::size_t(a_.ids[i]);
      rows[l] = a_.motion + id * 8, out[l] = a_.records + (a_.by_id ? id : i) * unsigned(kDiagonalStride);
    }
    FourMapped at[2][2];
    int near = 0;
    for (int half = 0; half < 2; ++half) {
      const double* const four[4] = {rows[4 * half], rows[4 * half + 1], rows[4 * half + 2],
                                     rows[4 * half + 3]};
      D4 start[3], end[3];
      transpose(four, 0, start), transpose(four, 4, end);
      int ends_near = 0xf;
      if (kStopped) {
        ends_near = bits(mapped(end).magnitude() <= D4::all(kFarthestEnd));
        for (int i = 0; i < 3; ++i) end[i] = D4::all(1 - a_.t_max) * start[i] + D4::all(a_.t_max) * end[i];
      }
      at[0][half] = mapped(start), at[1][half] = mapped(end);
      const D4 magnitude = max(at[0][half].magnitude(), at[1][half].magnitude());
      const D4 also = max(at[1][half].magnitude(), at[0][half].magnitude());  // where one is no number
      const auto is_near = (magnitude <= D4::all(kFarthest)) & (also <= D4::all(kFarthest));
      near |= (ends_near & bits(is_near)) << 4 * half;
      largest_ = max(select(is_near, magnitude, D4::all(0)), largest_);
    }
    for (int end = 0; end < 2; ++end) {
      F8 place[8];
      for (int k = 0; k < 8; ++k) place[k] = to_float(at[end][0].along(k), at[end][1].along(k));
      transpose(place);
      for (std::size_t l = 0; l < count; ++l) place[l].store(out[l] + end * 8);
    }
    const int far = ~near & ((1 << count) - 1);
    for (int open = far; open != 0; open &= open - 1) {
      float* record = out[lowest_lane(open)];
      F8::all(kFarOut).store(record), F8::all(-kFarOut).store(record + 8);
    }
    far_out_ = far_out_ || far != 0;
  }

  DiagonalRange range() const {
    double lanes[4], largest = 0;
    largest_.store(lanes);
    for (const double x : lanes) largest = x > largest ? x : largest;
    return {largest, far_out_};
  }

 private:
  FourMapped mapped(const D4 (&x)[3]) const {
    const D4 scale = D4::all(a_.map.scale);
    const double(&centre)[3] = a_.map.centre;
    return {(x[0] - D4::all(centre[0])) * scale, (x[1] - D4::all(centre[1])) * scale,
            (x[2] - D4::all(centre[2])) * scale};
  }

  const DiagonalArguments& a_;
  D4 largest_ = D4::all(0);
  bool far_out_ = false;
};

template <bool kStopped>
DiagonalRange write_all(const DiagonalArguments& a, std::size_t first, std::size_t last) {
  DiagonalWriter<kStopped> writer(a);
  for (; first < last; first += 8) writer.write(first, last - first < 8 ? last - first : 8);
  return writer.range();
}

}  // namespace

DiagonalRange write_records(const DiagonalArguments& a, std::size_t first, std::size_t last) {
  return a.t_max == 1 ? write_all<false>(a, first, last) : write_all<true>(a, first, last);
}

}  // namespace ONSET_ISA
}  // namespace onset
