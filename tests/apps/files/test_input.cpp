// Files are read as they are: lines of any length, and nothing of a file that changes meanwhile.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "files/error.hpp"
#include "files/input.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"

namespace {

class File {
 public:
  explicit File(const std::string& bytes) { append(bytes); }
  ~File() { std::filesystem::remove(path); }
  void append(const std::string& bytes) const {
    std::ofstream(path, std::ios::binary | std::ios::app) << bytes;
  }

  const std::string path =
      (std::filesystem::temp_directory_path() /
       ("onset_input_" + std::to_string(getpid()) + "_" + std::to_string(made++) + ".txt"))
          .string();

 private:
  static inline int made = 0;
};

std::string fault(const std::function<void()>& work) {
  try {
    work();
  } catch (const app::InputError& e) {
    return e.what();
  }
  return "";
}

std::vector<std::string> lines_of(const std::string& path) {
  app::InputLines lines(path);
  std::vector<std::string> all;
  for (std::string_view line; lines.next(line);) {
    all.emplace_back(line);
    REQUIRE(lines.number() == all.size());
  }
  REQUIRE(lines.at_end());
  return all;
}

}  // namespace

TEST_CASE("lines are those of the file, whatever the chunks that it is read by", "[unit]") {
  std::mt19937_64 random(onset::oracle::fuzz_seed());
  for (int i = 0; i < onset::oracle::fuzz(100); ++i) {
    std::vector<std::string> expected(random() % 6);
    std::string text = random() % 2 ? "\xEF\xBB\xBF" : "";
    for (std::string& line : expected) {
      const std::size_t length = random() % 3 ? random() % 40 : (1u << 16) - 5 + random() % 10;
      for (std::size_t k = 0; k < length; ++k) line += char('a' + random() % 26);
      text += line + (random() % 2 ? "\r\n" : "\n");
    }
    if (random() % 2 && !expected.empty() && !expected.back().empty())
      text.erase(text.find_last_not_of("\r\n") + 1);
    const File file(text);
    REQUIRE(lines_of(file.path) == expected);
    if (text.find('\r') == text.npos) REQUIRE(app::read_text(file.path) == text);
  }
}

TEST_CASE("lines that are too long, and bytes that are no text, are named", "[unit]") {
  const std::string longest(app::InputLines::kLongest, 'x');
  CHECK(lines_of(File("a\n" + longest + "\nb").path) == std::vector<std::string>{"a", longest, "b"});
  const File too_long("a\n" + longest + "x\n");
  CHECK(fault([&] { lines_of(too_long.path); }).find("txt:2: a line of more than 1048576 bytes") !=
        std::string::npos);
  const File binary(std::string("a\r\nb\nc\0d\n", 9));
  CHECK(fault([&] { lines_of(binary.path); }).find("txt:3: a byte 0") != std::string::npos);
  CHECK(fault([&] { app::read_text(binary.path); }).find("txt:3: a byte 0") != std::string::npos);
}

TEST_CASE("a file that changes while it is read is no file to rely on", "[unit]") {
  const std::string text(200000, 'x');
  const auto read_on = [&](const std::function<void(const File&)>& change) {
    const File file(text);
    return fault([&] {
      app::InputFile input(file.path);
      std::string head(1000, ' ');
      REQUIRE(input.read(head.data(), head.size()) == head.size());
      change(file);
      app::read_rest(input, file.path, head, true);
    });
  };
  CHECK(read_on([](const File&) {}) == "");
  const std::string changed = "was changed while it was read";
  CHECK(read_on([](const File& file) { file.append("y"); }).find(changed) != std::string::npos);
  CHECK(read_on([](const File& file) { std::filesystem::resize_file(file.path, 5000); }).find(changed) !=
        std::string::npos);
  // Another in its place is none of ours: the old one is read to its end.
  CHECK(read_on([](const File& file) {
          std::ofstream(file.path + ".new") << "other";
          std::filesystem::rename(file.path + ".new", file.path);
        }) == "");
}
