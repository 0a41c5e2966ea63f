# genu_layer(NAME [LAYERS ...] [LIBRARIES ...] [PRIVATE ...]): the static library genu_NAME from src/genu/NAME/*.cpp.
# LAYERS and LIBRARIES are part of its public face; PRIVATE libraries are seen by its .cpp files alone.
function(genu_layer name)
  cmake_parse_arguments(arg "" "" "LAYERS;LIBRARIES;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/genu/${name}/*.cpp)
  add_library(genu_${name} STATIC ${sources})
  target_include_directories(genu_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM arg_LAYERS PREPEND genu_)
  target_link_libraries(genu_${name} PUBLIC ${arg_LAYERS} ${arg_LIBRARIES} PRIVATE genu_options)
  # Third-party headers are not ours to keep free of warnings.
  foreach(library ${arg_PRIVATE})
    target_link_libraries(genu_${name} PRIVATE ${library})
  endforeach()
endfunction()
