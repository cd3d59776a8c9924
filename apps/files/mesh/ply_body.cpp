#include "files/mesh/ply_body.hpp"

#include <algorithm>
#include <cstring>

#include "files/text_lines.hpp"

namespace app {
namespace {

class TextBody : public PlyBody {
 public:
  TextBody(const PlyHeader& header, const MeshBuilder& mesh)
      : mesh_(mesh), lines_(header.data, header.lines) {}

  void begin_row(Place place) override {
    place_ = place;
    words_.clear();
    next_ = 0;
    for (std::string_view line; words_.empty();) {
      if (!lines_.next(line)) mesh_.fail(place_, "is not there: the file ends before it");
      split_words(line, words_);
    }
    place_.line = lines_.number();
  }

  void end_row() override {
    if (next_ < words_.size())
      mesh_.fail(place_, "has " + std::to_string(words_.size()) + " values, " + std::to_string(next_) +
                             " expected: " + quoted(words_));
  }

  double real(PlyType) override {
    const std::string_view word = take();
    const std::optional<double> value = parse_double(word);
    if (!value) mesh_.fail(place_, "is not three finite numbers: " + quoted(words_));
    return *value;
  }

  std::int64_t whole(PlyType) override {
    const std::string_view word = take();
    const std::optional<std::int64_t> value = parse_whole(word);
    if (!value) mesh_.fail(place_, "has " + quoted(word) + " where a vertex index is expected");
    return *value;
  }

  void skip(PlyType, std::int64_t count) override {
    if (std::size_t(count) > words_.size() - next_) too_few();
    next_ += std::size_t(count);
  }

  std::int64_t length(const PlyProperty& list) override {
    const std::string_view word = take();
    const std::optional<std::int64_t> value = parse_whole(word);
    if (!value || *value < 0 || std::size_t(*value) > words_.size() - next_)
      mesh_.fail(place_,
                 "says that list " + list.name + " has " + quoted(word) + " values: " + quoted(words_));
    return *value;
  }

  void end() override {
    for (std::string_view line; lines_.next(line);) {
      split_words(line, words_);
      if (!words_.empty()) mesh_.fail(lines_.number(), "more than the header tells of: " + quoted(words_));
    }
  }

  std::size_t bytes_left() const override { return lines_.left(); }
  std::string text() const override { return quoted(words_); }

 private:
  std::string_view take() {
    if (next_ == words_.size()) too_few();
    return words_[next_++];
  }
  [[noreturn]] void too_few() const { mesh_.fail(place_, "has too few values: " + quoted(words_)); }

  const MeshBuilder& mesh_;
  Lines lines_;
  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
};

class BinaryBody : public PlyBody {
 public:
  BinaryBody(const PlyHeader& header, const MeshBuilder& mesh)
      : mesh_(mesh), rest_(header.data), big_(header.encoding == PlyHeader::Encoding::big_endian) {}

  void begin_row(Place place) override { place_ = place; }

  double real(PlyType type) override {
    if (type == PlyType::float32) return take<float>();
    if (type == PlyType::float64) return take<double>();
    return double(whole(type));
  }

  std::int64_t whole(PlyType type) override {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      default:
        return take<std::uint32_t>();
    }
  }

  void skip(PlyType type, std::int64_t count) override {
    const std::size_t bytes = bytes_of(type) * std::size_t(count);
    if (bytes > rest_.size()) cut_off();
    rest_.remove_prefix(bytes);
  }

  std::int64_t length(const PlyProperty& list) override {
    const std::int64_t length = whole(list.count_type);
    if (length < 0 || std::size_t(length) > rest_.size() / bytes_of(list.type))
      mesh_.fail(place_, "says that list " + list.name + " has " + std::to_string(length) +
                             " values, the file has " + std::to_string(rest_.size()) + " bytes left");
    return length;
  }

  void end() override {
    if (rest_.find_first_not_of(" \t\r\n") != rest_.npos)
      mesh_.fail(0, std::to_string(rest_.size()) + " bytes more than the header tells of");
  }

  std::size_t bytes_left() const override { return rest_.size(); }

 private:
  [[noreturn]] void cut_off() const { mesh_.fail(place_, "is cut off: the file ends within it"); }

  template <class T>
  T take() {
    if (sizeof(T) > rest_.size()) cut_off();
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    const std::uint16_t one = 1;
    const bool little_here = *reinterpret_cast<const unsigned char*>(&one) == 1;
    if (big_ == little_here) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  const MeshBuilder& mesh_;
  std::string_view rest_;
  bool big_;
};

}  // namespace

std::unique_ptr<PlyBody> make_ply_body(const PlyHeader& header, const MeshBuilder& mesh) {
  if (header.encoding == PlyHeader::Encoding::ascii) return std::make_unique<TextBody>(header, mesh);
  return std::make_unique<BinaryBody>(header, mesh);
}

}  // namespace app
