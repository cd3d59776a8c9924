// The lines and words of a text file, with what their numbers are exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

// A byte order mark is no part of a text.
std::string_view without_mark(std::string_view text);

// Lines end with LF, CR LF or CR, the last one anyhow.
class Lines {
 public:
  // `number`: of the line before.
  explicit Lines(std::string_view text, std::size_t number = 0) : rest_(text), number_(number) {}
  bool next(std::string_view& line);
  std::size_t number() const { return number_; }  // of the line that next() gave, from 1
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  std::size_t number_;
};

// Split at blanks, tabs and the like. What starts with '#' is a comment up to the line's end.
void split_words(std::string_view line, std::vector<std::string_view>& words);

// The nearest double, whatever the locale is: infinite beyond the largest, 0 below the smallest. None where
// the word is no number; nan and inf are.
std::optional<double> parse_double(std::string_view word);

// None where the word is no whole number, or beyond 64 bits.
std::optional<std::int64_t> parse_whole(std::string_view word);

// "1 face", "2 faces"; "1 entry", "2 entries" where the plural is given.
std::string counted(std::size_t count, const std::string& one, const std::string& several = "");

// For messages about a broken file, whose bytes are no words for a terminal: without control characters, and
// cut off where it is longer than a few lines.
std::string shown(std::string cause);

// For messages: in quotes, cut off after some length.
std::string quoted(std::string_view word);
std::string quoted(const std::vector<std::string_view>& words);

}  // namespace app
