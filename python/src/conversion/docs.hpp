// Docstrings: what the public headers say, by name.
#pragma once

namespace onset_python {

// The comment above a declaration of include/onset/: "Class.member", "function", "function#2" for the second
// overload that has one. Empty where there is none. Made by python/docstrings.py.
const char* doc(const char* name);

}  // namespace onset_python
