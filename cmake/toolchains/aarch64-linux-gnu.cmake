# Compiles for 64-bit Arm with Debian's cross compiler, and runs what was made under qemu: scripts/test-arm.sh.
#   ONSET_ARM_ROOT  a folder with usr/lib/aarch64-linux-gnu, where the libraries are that the compiler does not bring
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ONSET_ARM_ROOT)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CROSSCOMPILING_EMULATOR "qemu-aarch64;-L;/usr/aarch64-linux-gnu")
# What is headers alone is this system's own.
set(CMAKE_FIND_ROOT_PATH ${ONSET_ARM_ROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
