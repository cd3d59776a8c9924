#include "files/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <locale>
#include <sstream>

namespace app {
namespace {

constexpr std::string_view kMark = "\xEF\xBB\xBF", kBlanks = " \t\v\f\r\n";

// from_chars says "out of range" both below the smallest double and beyond the largest.
double out_of_range(std::string_view word) {
  std::istringstream in{std::string(word)};
  in.imbue(std::locale::classic());
  double value = 0;
  if (in >> value) return value;
  const double infinity = std::numeric_limits<double>::infinity();
  return value > 0 ? infinity : value < 0 ? -infinity : 0;
}

}  // namespace

std::string_view without_mark(std::string_view text) {
  return text.substr(0, kMark.size()) == kMark ? text.substr(kMark.size()) : text;
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  ++number_;
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line = rest_.substr(0, end);
  const bool two = rest_.substr(end, 2) == "\r\n";
  rest_.remove_prefix(std::min(rest_.size(), end + (two ? 2 : 1)));
  return true;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == line.npos || line[begin] == '#') return;
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

std::optional<double> parse_double(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  return error == std::errc() ? value : out_of_range(word);
}

std::optional<std::int64_t> parse_whole(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::string counted(std::size_t count, const std::string& one, const std::string& several) {
  return std::to_string(count) + " " + (count == 1 ? one : several.empty() ? one + "s" : several);
}

std::string shown(std::string cause) {
  constexpr std::size_t kLength = 500;
  if (cause.size() > kLength) cause = cause.substr(0, kLength) + "...";
  for (char& c : cause)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return cause;
}

std::string quoted(std::string_view word) {
  constexpr std::size_t kLength = 60;
  std::string text("'");
  return text.append(word.substr(0, kLength)).append(word.size() > kLength ? "...'" : "'");
}

std::string quoted(const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words) text.append(text.empty() ? "" : " ").append(word.substr(0, 100));
  return quoted(text);
}

}  // namespace app
