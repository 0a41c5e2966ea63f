# Headers nearly every file includes, read once for all: a third of the time to build. Each file still includes what it
# uses; -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
set(genu_common_headers <algorithm> <array> <cmath> <filesystem> <functional> <limits> <map> <memory> <numbers>
    <optional> <string> <vector> <Eigen/Core> <Eigen/Geometry> <Eigen/LU>)

# genu_position_independent(TARGET): its objects may become part of libgenu.so (cmake/install.cmake). Calls inside a file
# stay as direct as they are in a program. Not for fuzzing: its programs share the headers read once for all.
function(genu_position_independent target)
  if(GENU_FUZZ)
    return()
  endif()
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
endfunction()

# genu_layer(NAME [LAYERS ...] [LIBRARIES ...] [PRIVATE ...]): the static library genu_NAME from src/genu/NAME/*.cpp.
# LAYERS and LIBRARIES are part of its public face; PRIVATE libraries are seen by its .cpp files alone.
function(genu_layer name)
  cmake_parse_arguments(arg "" "" "LAYERS;LIBRARIES;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/genu/${name}/*.cpp)
  add_library(genu_${name} STATIC ${sources})
  target_include_directories(genu_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  genu_position_independent(genu_${name})
  list(TRANSFORM arg_LAYERS PREPEND genu_)
  target_link_libraries(genu_${name} PUBLIC ${arg_LAYERS} ${arg_LIBRARIES} PRIVATE genu_options)
  if(name STREQUAL "core")
    target_precompile_headers(genu_core PRIVATE ${genu_common_headers} <fmt/format.h>)
  else()
    target_precompile_headers(genu_${name} REUSE_FROM genu_core)
  endif()
  # Third-party headers are not ours to keep free of warnings.
  foreach(library ${arg_PRIVATE})
    target_link_libraries(genu_${name} PRIVATE ${library})
  endforeach()
endfunction()
