// What the system says of this process: memory, handles, time.
#pragma once

#include <cstdint>

namespace onset::tests {

// Bytes that are resident now.
std::int64_t resident_bytes();
// Open files, and threads.
int open_files();
int threads_alive();
// Seconds that all threads of this process have computed for.
double cpu_seconds();

}  // namespace onset::tests
