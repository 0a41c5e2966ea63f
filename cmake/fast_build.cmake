# What makes building faster where it is installed: ccache keeps what was compiled before, mold links.
find_program(GENU_CCACHE ccache)
if(GENU_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Of headers read once for all ccache sees their contents, not when they were made.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${GENU_CCACHE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess)
  endif()
endif()
find_program(GENU_MOLD mold)
if(GENU_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
