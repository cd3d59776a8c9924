# Compiles for another system with zig, which holds the headers and the libraries of several: scripts/test-portable.sh makes what is named here.
#   ONSET_ZIG_TOOLS   a folder with the programs cxx-<target>, ar, ranlib and rc
#   ONSET_ZIG_TARGET  x86_64-windows-gnu, aarch64-macos, ...
#   ONSET_HEADERS     a folder with boost, and nothing of this system's beside it
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ONSET_ZIG_TOOLS ONSET_ZIG_TARGET ONSET_HEADERS)
if(ONSET_ZIG_TARGET MATCHES "^([^-]+)-windows")
  set(CMAKE_SYSTEM_NAME Windows)
  set(CMAKE_RC_COMPILER ${ONSET_ZIG_TOOLS}/rc)
elseif(ONSET_ZIG_TARGET MATCHES "^([^-]+)-macos")
  set(CMAKE_SYSTEM_NAME Darwin)
else()
  message(FATAL_ERROR "ONSET_ZIG_TARGET is '${ONSET_ZIG_TARGET}', which is neither for Windows nor for macOS")
endif()
set(CMAKE_SYSTEM_PROCESSOR ${CMAKE_MATCH_1})
set(CMAKE_CXX_COMPILER ${ONSET_ZIG_TOOLS}/cxx-${ONSET_ZIG_TARGET})
set(CMAKE_AR ${ONSET_ZIG_TOOLS}/ar)
set(CMAKE_RANLIB ${ONSET_ZIG_TOOLS}/ranlib)
set(CMAKE_FIND_ROOT_PATH ${ONSET_HEADERS})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
