// ONSET_API marks what the shared library shows; all else stays hidden.
//
// On Windows whoever uses a shared library is compiled with ONSET_SHARED, and that with ONSET_BUILDING; a
// static one needs neither. The targets of CMake and the pkg-config file see to it.
#pragma once

#if !defined(_WIN32) && !defined(__CYGWIN__)
#define ONSET_API __attribute__((visibility("default")))
#elif defined(ONSET_BUILDING)
#define ONSET_API __declspec(dllexport)
#elif defined(ONSET_SHARED)
#define ONSET_API __declspec(dllimport)
#else
#define ONSET_API
#endif
