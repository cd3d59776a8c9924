// Structured inputs and bytes, both ways by one description: a fuzzer's bytes become an input, and an input
// becomes the bytes of a seed.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace onset::fuzz {

// Reads from bytes, or appends to them. Behind the last byte there are zeros, so that all bytes mean an
// input.
class Bytes {
 public:
  Bytes() = default;  // to write
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size), reads_(true) {}

  bool reads() const { return reads_; }
  std::size_t left() const { return left_; }
  const std::string& written() const { return written_; }
  // All that is left.
  std::string rest() {
    std::string text(reinterpret_cast<const char*>(data_), left_);
    left_ = 0;
    return text;
  }

  // A whole number or an enumerator in [low, high].
  template <class T>
  void whole(T& value, std::int64_t low, std::int64_t high) {
    const std::uint64_t count = std::uint64_t(high) - std::uint64_t(low) + 1;  // 0: all
    const std::size_t size = count == 0 || count > 1ull << 32 ? 8
                             : count > 1ull << 16             ? 4
                             : count > 256                    ? 2
                                                              : 1;
    std::uint64_t raw = std::uint64_t(std::int64_t(value)) - std::uint64_t(low);
    raw = bits(raw, size);
    if (reads_) value = T(std::int64_t(std::uint64_t(low) + (count ? raw % count : raw)));
  }
  void flag(bool& value) { whole(value, 0, 1); }
  // Any double at all.
  void real(double& value) {
    std::uint64_t raw;
    std::memcpy(&raw, &value, sizeof raw);
    raw = bits(raw, 8);
    std::memcpy(&value, &raw, sizeof raw);
  }
  // One of a list.
  template <class T, std::size_t N>
  void one_of(T& value, const T (&list)[N]) {
    std::size_t i = 0;
    while (i + 1 < N && !(list[i] == value)) ++i;
    whole(i, 0, std::int64_t(N) - 1);
    if (reads_) value = list[i];
  }

 private:
  std::uint64_t bits(std::uint64_t raw, std::size_t size) {
    if (!reads_) {
      for (std::size_t i = 0; i < size; ++i) written_ += char(raw >> 8 * i);
      return raw;
    }
    raw = 0;
    for (std::size_t i = 0; i < size && left_ > 0; ++i, ++data_, --left_)
      raw |= std::uint64_t(*data_) << 8 * i;
    return raw;
  }

  const std::uint8_t* data_ = nullptr;
  std::size_t left_ = 0;
  bool reads_ = false;
  std::string written_;
};

}  // namespace onset::fuzz
