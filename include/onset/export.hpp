// ONSET_API marks what the shared library shows; all else stays hidden.
#pragma once

#if defined(_WIN32)
#define ONSET_API
#else
#define ONSET_API __attribute__((visibility("default")))
#endif
