# ccache keeps what was compiled before, where it is installed. Not mold: a program that it links takes ten million
# instructions more to start, the time of ten poses (tools/count-instructions).
find_program(GENU_CCACHE ccache)
if(GENU_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Of headers read once for all ccache sees their contents, not when they were made.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${GENU_CCACHE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess)
  endif()
endif()
