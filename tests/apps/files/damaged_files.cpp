#include "tests/apps/files/damaged_files.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace onset::tests {
namespace {

const std::string kPlyHeader =
    "element vertex 4\nproperty float x\nproperty double y\nproperty float z\nproperty list uchar short "
    "more\n"
    "element face 2\nproperty list uint ushort vertex_indices\nelement edge 1\nproperty int vertex1\n"
    "property uchar vertex2\nend_header\n";

// `value` in the order of bytes that is asked for.
template <class T>
void append(std::string& bytes, T value, bool big) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  if (big) std::reverse(raw.begin(), raw.end());
  bytes += raw;
}

std::string binary_ply(bool big) {
  std::string bytes =
      std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + kPlyHeader;
  for (int v = 0; v < 4; ++v) {
    append(bytes, float(v), big), append(bytes, double(v * v), big), append(bytes, 0.5f, big);
    append(bytes, std::uint8_t(1), big), append(bytes, std::int16_t(7), big);
  }
  for (const int corners : {3, 4}) {
    append(bytes, std::uint32_t(corners), big);
    for (int i = 0; i < corners; ++i) append(bytes, std::uint16_t(i), big);
  }
  append(bytes, std::int32_t(0), big), append(bytes, std::uint8_t(3), big);
  return bytes;
}

std::string binary_off() {
  std::string bytes = "OFF BINARY\n";
  for (const int n : {4, 2, 0}) append(bytes, std::int32_t(n), true);
  for (int i = 0; i < 12; ++i) append(bytes, float(i * i), true);
  for (const int n : {3, 0, 1, 2, 0, 4, 0, 1, 2, 3, 1}) append(bytes, std::int32_t(n), true);
  append(bytes, 0.5f, true);
  return bytes;
}

std::string binary_stl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t(2), false);
  for (int f = 0; f < 2; ++f) {
    for (int i = 0; i < 12; ++i) append(bytes, float((f + i) * i), false);
    append(bytes, std::uint16_t(0), false);
  }
  return bytes;
}

std::size_t below(std::size_t n, std::mt19937_64& random) {
  return std::size_t(random() % std::max<std::size_t>(n, 1));
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A run of digits, where there is one, or a word somewhere.
void write_extreme_number(std::string& bytes, std::mt19937_64& random) {
  const std::string numbers[] = {"-1",
                                 "0",
                                 "255",
                                 "65536",
                                 "2147483648",
                                 "4294967297",
                                 "1000000000",
                                 "9223372036854775807",
                                 "9223372036854775808",
                                 "18446744073709551615",
                                 "99999999999999999999",
                                 "1e9",
                                 "1e400",
                                 "1e-400",
                                 "nan",
                                 "-inf",
                                 "0x7",
                                 std::string(11000, '7')};
  const std::string& number = numbers[below(std::size(numbers), random)];
  std::size_t begin = below(bytes.size(), random);
  while (begin < bytes.size() && !is_digit(bytes[begin])) ++begin;
  std::size_t end = begin;
  while (end < bytes.size() && is_digit(bytes[end])) ++end;
  bytes.replace(begin, end - begin, number);
}

// Four bytes, which may be a count.
void write_extreme_bytes(std::string& bytes, std::mt19937_64& random) {
  const std::uint32_t counts[] = {0xffffffff, 0x7fffffff, 0x80000000, 0x10000, 0x3fffffff, 0};
  std::string raw;
  append(raw, counts[below(std::size(counts), random)], random() % 2);
  const std::size_t at = below(bytes.size(), random);
  bytes.replace(at, std::min<std::size_t>(4, bytes.size() - at), raw);
}

void swap_lines(std::string& bytes, std::mt19937_64& random) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size() - 1) + 1;
    lines.push_back(bytes.substr(begin, end - begin));
    begin = end;
  }
  if (lines.empty()) return;
  std::swap(lines[below(lines.size(), random)], lines[below(lines.size(), random)]);
  bytes.clear();
  for (const std::string& line : lines) bytes += line;
}

}  // namespace

std::vector<SampleFile> mesh_files() {
  return {{"a.obj",
           "# c\nv 0 0 0\nv 1 0 0 1\nv 1 1 \\\n0\nv 0 1e0 0\nvn 0 0 1\nf 1//1 2/1 3/1/1 -1\nl 1 2 4\np 3\ns "
           "off\nxy\n"},
          {"a.ply", "ply\nformat ascii 1.0\n" + kPlyHeader +
                        "0 0 0 0\n1 0 0 1 5\n1 1 0 0\n0 1 0 2 1 2\n3 0 1 2\n4 0 1 2 3\n0 3\n"},
          {"a.ply", binary_ply(false)},
          {"a.ply", binary_ply(true)},
          {"a.off", "COFF\n# c\n4 3 0\n0 0 0 1 1 1 1\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 0.5\n4 0 1 2 3\n2 0 3\n"},
          {"a.off", binary_off()},
          {"a.stl",
           "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
           "endfacet\nendsolid a\n"},
          {"a.stl", binary_stl()}};
}

std::vector<SampleFile> query_files() {
  std::string queries;
  for (const char* truth : {"1", "0"})
    for (const char* row :
         {"1,2,-3,4,0,1,", "0,1,1,1,5,10,", "12345678901234567890,12345678901234567890,0,7,1,8,",
          "-1,1,+1,64,0,1,", "1,2,-3,4,0,1,", "0,1,1,1,0,1,", "1,1,0,7,1,8,", "1,1,1,64,0,1,"})
      queries += std::string(row) + truth + "\n";
  return {{"queries.csv", queries},
          {"truth.csv", "kind,a,b,toi_lo,toi_hi\nvf,3,0,0x1p-1,0.5\nvf,4,0,,\nee,0,3,0.25,1\n"},
          {"pairs.json", "[[3, 12], [13, 4], [6, 11]]"},
          {"flags.json", "[true, false, true]"},
          {"toi.csv", "0.5,0.5\ninf,inf\n"}};
}

void damage(std::string& bytes, std::mt19937_64& random) {
  const std::string words[] = {"\n", " ", "\\\n", "#", "\r", ",", "[", "]", "\"", std::string(1, '\0')};
  const std::size_t at = below(bytes.size(), random),
                    length = std::min(1 + below(9, random), bytes.size() - at);
  switch (below(9, random)) {
    case 0:
      if (!bytes.empty()) bytes[at] = char(random());
      return;
    case 1:
      bytes.erase(at, length);
      return;
    case 2:
      bytes.insert(at, bytes.substr(below(bytes.size(), random), 1 + below(40, random)));
      return;
    case 3:
      bytes.replace(at, std::min<std::size_t>(length, 2), words[below(std::size(words), random)]);
      return;
    case 4:
      std::fill_n(bytes.begin() + std::ptrdiff_t(at), length, random() % 2 ? '\xff' : '\0');
      return;
    case 5:
      if (random() % 4 == 0) bytes.resize(at);
      return;
    case 6:
      return swap_lines(bytes, random);
    case 7:
      return write_extreme_bytes(bytes, random);
    default:
      return write_extreme_number(bytes, random);
  }
}

}  // namespace onset::tests
