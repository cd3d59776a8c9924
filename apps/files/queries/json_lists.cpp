#include "files/queries/json_lists.hpp"

#include <nlohmann/json.hpp>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

// Takes a list whose entries are lists of numbers, or flags. Whatever else comes ends the parse.
class ListReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  ListReader(std::string path, std::string expected)
      : path_(std::move(path)), expected_(std::move(expected)) {}

  bool null() override { refuse("null"); }
  bool boolean(bool) override { refuse("a truth value"); }
  bool number_integer(number_integer_t value) override { refuse(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { refuse(std::to_string(value)); }
  bool number_float(number_float_t, const string_t& text) override { refuse(text); }
  bool string(string_t& text) override { refuse("the text " + app::quoted(text)); }
  bool binary(binary_t&) override { refuse("bytes"); }
  bool start_object(std::size_t) override { refuse("an object"); }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override {
    if (++depth_ > most_depth_) refuse("a list");
    return true;
  }
  bool end_array() override { return --depth_, true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& e) override {
    throw InputError(path_ + ": " + shown(e.what()));
  }

 protected:
  [[noreturn]] void refuse(const std::string& what) const {
    const std::string entry =
        entries_ > 0 ? "behind " + counted(entries_, "entry", "entries") : "at its start";
    throw InputError(path_ + ": " + shown(what + " " + entry + ", " + expected_ + " expected"));
  }

  std::size_t entries_ = 0;  // that are complete
  int depth_ = 0, most_depth_ = 1;

 private:
  std::string path_, expected_;
};

class PairReader : public ListReader {
 public:
  explicit PairReader(const std::string& path) : ListReader(path, "[[id, id], ...]") { most_depth_ = 2; }

  bool number_integer(number_integer_t value) override {
    if (depth_ != 2 || ids_ == 2) refuse(std::to_string(value));
    pair_[ids_++] = value;
    return true;
  }
  bool number_unsigned(number_unsigned_t value) override {
    if (value > std::uint64_t(INT64_MAX)) refuse(std::to_string(value));
    return number_integer(number_integer_t(value));
  }
  bool start_array(std::size_t size) override {
    ids_ = 0;
    return ListReader::start_array(size);
  }
  bool end_array() override {
    if (depth_ == 2 && ids_ != 2) refuse("a list of " + counted(ids_, "number"));
    if (depth_ == 2) pairs.push_back(pair_), ++entries_;
    return ListReader::end_array();
  }

  std::vector<std::array<std::int64_t, 2>> pairs;

 private:
  std::array<std::int64_t, 2> pair_{};
  std::size_t ids_ = 0;
};

class FlagReader : public ListReader {
 public:
  explicit FlagReader(const std::string& path) : ListReader(path, "[true, false, ...]") {}

  bool boolean(bool value) override {
    if (depth_ != 1) refuse("a truth value");
    flags.push_back(value), ++entries_;
    return true;
  }

  std::vector<bool> flags;
};

template <class Reader>
Reader parsed(const std::string& path) {
  Reader reader(path);
  nlohmann::json::sax_parse(read_text(path), &reader);
  return reader;
}

}  // namespace

std::vector<std::array<std::int64_t, 2>> read_id_pairs(const std::string& path) {
  return parsed<PairReader>(path).pairs;
}

std::vector<bool> read_flags(const std::string& path) { return parsed<FlagReader>(path).flags; }

}  // namespace app
