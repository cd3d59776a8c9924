// Where the real data with truth lies: the folder that the environment variable ONSET_DATA names. Tests that
// need it are skipped without it.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace onset::scenes {

// Empty where there is none; then says so, with the name of the test.
inline std::string data_folder(const char* test) {
  const char* folder = std::getenv("ONSET_DATA");
  if (!folder || !*folder) {
    std::printf("skipped: %s (ONSET_DATA is not set)\n", test);
    return {};
  }
  return folder;
}

}  // namespace onset::scenes
