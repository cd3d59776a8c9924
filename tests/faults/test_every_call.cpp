// every_call() leaves out no function of the public headers, and gives the same bytes each time, whatever
// locale the host has.
#include <filesystem>
#include <fstream>
#include <locale>
#include <regex>
#include <set>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/src/support/every_call.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Names that are followed by a parenthesis, outside of comments: functions that are declared, and those that
// inline ones call.
std::set<std::string> names_called_in(const std::string& text) {
  const std::string code = std::regex_replace(text, std::regex("//[^\n]*|#[^\n]*"), "");
  std::set<std::string> names;
  const std::regex call("([A-Za-z_]\\w*)\\s*\\(");
  for (std::sregex_iterator i(code.begin(), code.end(), call), end; i != end; ++i) names.insert((*i)[1]);
  return names;
}

// Declared at the start of a line, or two deep in a class: type, name, parenthesis. What is private is not
// indented by less.
std::set<std::string> functions_declared_in(const std::string& text) {
  std::set<std::string> names;
  std::istringstream lines(text);
  const std::regex declaration(
      "^(?:  )?(?:ONSET_API |inline |static |explicit |constexpr )*(?:const )?[A-Za-z_][\\w:]*(?:<[^()]*>)?[ "
      "*&]+(?:const )?([a-z_]\\w*)\\(.*");
  bool open = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(" private:", 0) == 0) open = false;
    if (line.rfind("}", 0) == 0) open = true;
    std::smatch found;
    if (open && std::regex_match(line, found, declaration) && found[1] != "if") names.insert(found[1]);
  }
  return names;
}

}  // namespace

TEST_CASE("every function of the public headers is in the list of calls", "[faults]") {
  const std::filesystem::path root = ONSET_ROOT;
  std::string calls;
  for (const char* file :
       {"every_call.cpp", "mesh_calls.cpp", "plane_calls.cpp", "adapter_calls.cpp", "toolkit_calls.cpp"})
    calls += read(root / "tests/src/support" / file);
  const std::set<std::string> called = names_called_in(calls);
  // ipc_toolkit.hpp needs ipc-toolkit; the others are parts, which the adapter's calls reach.
  const std::set<std::string> parts = {"ipc_toolkit.hpp",     "arguments.hpp",    "box_pairs.hpp",
                                       "mesh_maps.hpp",       "pair_queries.hpp", "plane_query.hpp",
                                       "mesh_with_planes.hpp"};
  int functions = 0;
  for (const auto& header : std::filesystem::recursive_directory_iterator(root / "include/onset")) {
    if (header.path().extension() != ".hpp" || parts.count(header.path().filename().string()) > 0) continue;
    for (const std::string& name : functions_declared_in(read(header.path()))) {
      CAPTURE(header.path().filename().string(), name);
      // What loops over a range and brackets call is not called by name.
      if (name == "begin" || name == "end" || name == "operator") continue;
      // Called with a template argument, protected, or variables that are made with parentheses.
      if (name == "as" || name == "point" || name == "point3" || name == "closest" || name == "r") continue;
      CHECK(called.count(name) == 1);
      ++functions;
    }
  }
  std::printf("%d functions in the public headers\n", functions);
  CHECK(functions > 90);
}

TEST_CASE("the list of calls gives the same answers each time", "[faults]") {
  for (const Subject& subject : small_subjects()) {
    const Mesh mesh = subject.mesh();
    for (const Call& call : every_call())
      for (const int threads : {0, 1, 2}) {
        CAPTURE(subject.name, call.name, threads);
        Options options;
        options.threads = threads;
        const Answer answer = call(mesh, subject, options);
        CHECK(answer == call(subject.mesh(), subject, {}));
        CHECK(answer != Answer());
      }
  }
}

TEST_CASE("no locale of the host changes an answer", "[faults]") {
  struct Other : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\1"; }
  };
  for (const Subject& subject : small_subjects())
    for (const Call& call : every_call()) {
      CAPTURE(subject.name, call.name);
      const Answer expected = call(subject.mesh(), subject, {});
      const std::locale host = std::locale::global(std::locale(std::locale(), new Other));
      const Answer answer = call(subject.mesh(), subject, {});
      std::locale::global(host);
      CHECK(answer == expected);
    }
}
