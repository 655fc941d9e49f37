# Settings of the whole build: language, flags, options, where things are installed.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

# -O2 costs a factor of ten in the kernels, so an unnamed build type means Release (-O3).
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

option(DEIXIS_BUILD_TESTS "Build the tests" ON)
option(DEIXIS_BUILD_BENCHMARKS "Build the benchmarks" ON)
option(DEIXIS_WARNINGS_AS_ERRORS "Treat warnings as errors" OFF)
option(DEIXIS_SANITISE "Build with the address and undefined-behaviour sanitisers" OFF)
option(DEIXIS_FUZZ "Build the fuzzers of test/fuzz (clang only)" OFF)

find_program(DEIXIS_CCACHE ccache)
if(DEIXIS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${DEIXIS_CCACHE}")
endif()

include(GNUInstallDirs)

# Flags that every target of ours gets. Plain x86-64 throughout: -march=native breaks Debian's PCL
# (Eigen's alignment is part of its ABI), and one build serves every robot.
add_library(deixis_flags INTERFACE)
target_compile_options(deixis_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  $<$<BOOL:${DEIXIS_WARNINGS_AS_ERRORS}>:-Werror>)
if(DEIXIS_SANITISE)
  # vptr is off: with gcc 12 it crashes LCM's C++ callbacks.
  target_compile_options(deixis_flags INTERFACE
    -fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(deixis_flags INTERFACE -fsanitize=address,undefined -fno-sanitize=vptr)
endif()
if(DEIXIS_FUZZ)
  target_compile_options(deixis_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
target_include_directories(deixis_flags INTERFACE "${CMAKE_SOURCE_DIR}")
target_compile_definitions(deixis_flags INTERFACE DEIXIS_VERSION="${PROJECT_VERSION}")

# Flags of files that hold hot kernels. They keep NaN and infinity meaningful, unlike -ffast-math,
# and let the compiler vectorise; measured equal or faster than -ffast-math.
set(DEIXIS_KERNEL_FLAGS
  -O3 -fno-math-errno -fno-trapping-math -fno-signed-zeros -fassociative-math -freciprocal-math)
# gcc's threaded jumps make control flow of choices between values; clang knows no such flag.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND DEIXIS_KERNEL_FLAGS -fno-thread-jumps)
endif()

# Kernels in several versions, of which the processor's own runs: see common/kernels/kernel.h. Not
# under the sanitisers, which are not ready yet when the version is chosen.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles([[
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
  int Twice(int x) { return 2 * x; }
  int main() { return Twice(0); }]] DEIXIS_COMPILER_HAS_TARGET_CLONES)
if(DEIXIS_COMPILER_HAS_TARGET_CLONES AND NOT DEIXIS_SANITISE AND NOT DEIXIS_FUZZ)
  target_compile_definitions(deixis_flags INTERFACE DEIXIS_HAS_TARGET_CLONES)
endif()
