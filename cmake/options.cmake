# Compiler flags, the same for every target. Debian's FCL is built with 16-byte Eigen alignment: no -march flags here,
# or types that cross that border would change their layout.
add_library(genu_options INTERFACE)
target_compile_options(genu_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
                       -Woverloaded-virtual -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 warns falsely of std::string (GCC bug 105651) where headers are read once for all.
  target_compile_options(genu_options INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread
                         -Wno-array-bounds)
endif()
target_compile_definitions(genu_options INTERFACE EIGEN_MAX_ALIGN_BYTES=16)
# No fused or reordered floating point: the same input gives the same bytes.
target_compile_options(genu_options INTERFACE -ffp-contract=off)
if(GENU_SANITIZE)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "GENU_SANITIZE needs Clang, which has libFuzzer: cmake --preset sanitizers")
  endif()
  # Left out of `undefined`: what the address sanitizer or the processor stops at anyway, a third of the time to build.
  # Added: a number too large for the integer it becomes.
  set(genu_checks -fsanitize=address,undefined,float-cast-overflow -fno-sanitize=null,alignment,object-size,vptr)
  target_compile_options(genu_options INTERFACE -fsanitize=fuzzer-no-link ${genu_checks} -fno-sanitize-recover=all
                         -fno-omit-frame-pointer)
  target_link_options(genu_options INTERFACE ${genu_checks})
endif()
if(GENU_TSAN)
  target_compile_options(genu_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(genu_options INTERFACE -fsanitize=thread)
  # oneTBB as it is installed tells the sanitizer nothing: plain threads stand in for it (tests/tsan/tbb/team.h).
  target_include_directories(genu_options BEFORE INTERFACE ${PROJECT_SOURCE_DIR}/tests/tsan)
endif()
