// What CGAL's PLY reader takes for granted about a header, checked before it reads on.
#pragma once

#include <istream>
#include <string>

namespace app {

// Reads the header from `in` and returns the reason why the file cannot be read, or an empty string. CGAL 5.5
// drops a property of a type that it does not know (everything after it is then misread), and takes a missing
// or integer coordinate for zero or crashes on it.
std::string ply_header_problem(std::istream& in);

}  // namespace app
