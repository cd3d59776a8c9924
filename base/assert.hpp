// Assertions of what the code around them relies on.
#pragma once

namespace onset {

// Writes what failed, and where, to stderr, and aborts.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace onset

// Aborts where the condition fails, if ONSET_ASSERTS is defined (the CMake option of that name, Debug
// builds); else the condition is not evaluated.
#ifdef ONSET_ASSERTS
#define ONSET_ASSERT(condition) \
  ((condition) ? void(0) : ::onset::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define ONSET_ASSERT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif
