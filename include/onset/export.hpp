// Marks what a shared library shows.
#pragma once

#if defined(_WIN32)
#define ONSET_API
#else
#define ONSET_API __attribute__((visibility("default")))
#endif
