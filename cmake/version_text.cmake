# genu_version_text(TARGET): what `genu --version` says of the build: commit, compiler, libraries. The commit is looked up
# at each build; what holds it changes only where it does. Run as a script (-DROOT=... -DOUT=...), it writes that.
if(CMAKE_SCRIPT_MODE_FILE)
  set(commit "")
  if(EXISTS ${ROOT}/.git)
    execute_process(COMMAND git -C ${ROOT} describe --always --dirty --abbrev=10 OUTPUT_VARIABLE commit
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
  file(CONFIGURE OUTPUT ${OUT} CONTENT "#define GENU_COMMIT \"${commit}\"\n")
  return()
endif()

set(genu_version_script ${CMAKE_CURRENT_LIST_FILE})
function(genu_version_text target)
  set(header ${PROJECT_BINARY_DIR}/version/genu_commit.h)
  add_custom_target(genu_commit BYPRODUCTS ${header} VERBATIM
                    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DOUT=${header} -P ${genu_version_script})
  add_dependencies(${target} genu_commit)
  set(libraries "Eigen ${Eigen3_VERSION} (MPL-2.0)" "FCL ${FCL_VERSION} (BSD-3-Clause)" "libccd (BSD-3-Clause)"
      "assimp ${assimp_VERSION} (BSD-3-Clause)" "SUNDIALS ${SUNDIALS_VERSION} (BSD-3-Clause)"
      "oneTBB ${TBB_VERSION} (Apache-2.0)" "toml++ ${tomlplusplus_VERSION} (MIT)" "CLI11 ${CLI11_VERSION} (BSD-3-Clause)"
      "fmt ${fmt_VERSION} (MIT)" "zlib ${ZLIB_VERSION_STRING} (Zlib)"
      "xxHash ${XXHASH_VERSION} (BSD-2-Clause)" "pugixml ${pugixml_VERSION} (MIT)")
  if(GENU_WITH_CGAL)
    list(APPEND libraries "CGAL ${CGAL_VERSION} (GPL-3.0-or-later)")
  endif()
  list(JOIN libraries "\\n" libraries)
  string(TOLOWER "${CMAKE_BUILD_TYPE}" type)
  if(GENU_SANITIZE OR GENU_TSAN)
    string(APPEND type ", with sanitizers")
  endif()
  set(source ${PROJECT_SOURCE_DIR}/tools/cli/version.cpp)
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON INCLUDE_DIRECTORIES
                              ${PROJECT_BINARY_DIR}/version OBJECT_DEPENDS ${header})
  set_property(SOURCE ${source} PROPERTY COMPILE_DEFINITIONS GENU_VERSION="${PROJECT_VERSION}" GENU_BUILD_TYPE="${type}"
               GENU_COMPILER="${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" GENU_LIBRARIES="${libraries}"
               GENU_LICENCE="${genu_licence}")
endfunction()
