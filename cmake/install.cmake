# What `cmake --install` puts where, and the .deb that CPack makes of it: everything that is installed is named here.
#
# bin/genu links the rooms into itself. lib/libgenu.so is the same rooms for other programs, with the libraries they
# use linked in privately: who uses genu::genu sees genu/genu.h and the headers that it includes, and nothing of Eigen,
# FCL, assimp, CGAL and the rest.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(genu_objects "")
foreach(room ${genu_rooms})
  list(APPEND genu_objects $<TARGET_OBJECTS:genu_${room}>)
endforeach()
if(GENU_WITH_CGAL)
  list(APPEND genu_objects $<TARGET_OBJECTS:genu_mesh_care_cgal>)
endif()
add_library(genu_library SHARED ${genu_objects})
set_target_properties(genu_library PROPERTIES OUTPUT_NAME genu EXPORT_NAME genu LINKER_LANGUAGE CXX
                      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_link_libraries(genu_library PRIVATE genu_api genu_judge genu_options)
target_link_options(genu_library PRIVATE -Wl,-Bsymbolic-functions -Wl,--as-needed)
target_include_directories(genu_library INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(genu_library INTERFACE cxx_std_20)

# Everything that `cmake --install` copies is built by this target.
add_custom_target(installed_files DEPENDS genu genu_library)

install(TARGETS genu DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS genu_library EXPORT genuTargets DESTINATION ${CMAKE_INSTALL_LIBDIR})
# What is not API is not installed.
install(FILES src/genu/genu.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/genu)
foreach(header meshes problem results scene table)
  install(FILES src/genu/api/${header}.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/genu/api)
endforeach()

set(genu_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/genu)
configure_package_config_file(cmake/genuConfig.cmake.in ${PROJECT_BINARY_DIR}/genuConfig.cmake
                              INSTALL_DESTINATION ${genu_package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/genuConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT genuTargets NAMESPACE genu:: DESTINATION ${genu_package_folder})
install(FILES ${PROJECT_BINARY_DIR}/genuConfig.cmake ${PROJECT_BINARY_DIR}/genuConfigVersion.cmake
        DESTINATION ${genu_package_folder})

# Scenes: the catalogue of `genu hard-cases`, and the knees that need no other data.
install(DIRECTORY tests/hard_cases DESTINATION ${CMAKE_INSTALL_DATADIR}/genu FILES_MATCHING
        PATTERN "*.toml" PATTERN "*.patch")
install(DIRECTORY meshes DESTINATION ${CMAKE_INSTALL_DATADIR}/genu PATTERN lenhart2015 EXCLUDE)

# Licences, those of what is compiled in too: the page of report.html tells its own.
file(READ src/report_page/bundle/page.html genu_notices)
string(REGEX REPLACE ".*<script type=\"text/plain\" id=\"genu-notices\">([^<]*)</script>.*" "\\1" genu_notices "${genu_notices}")
string(LENGTH "${genu_notices}" genu_notices_length)
if(genu_notices_length LESS 1000 OR genu_notices_length GREATER 20000)
  message(FATAL_ERROR "src/report_page/bundle/page.html holds no notices where they are looked for")
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS src/report_page/bundle/page.html)
configure_file(cmake/copyright.in copyright @ONLY)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff ${PROJECT_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN __pycache__ EXCLUDE)

# The manual page and the completions are written by the program, from its own table of commands.
set(genu_written ${PROJECT_BINARY_DIR}/written)
add_custom_command(TARGET genu POST_BUILD
  COMMAND ${CMAKE_COMMAND} -E make_directory ${genu_written}
  COMMAND $<TARGET_FILE:genu> man > ${genu_written}/genu.1
  COMMAND $<TARGET_FILE:genu> completion bash > ${genu_written}/genu.bash
  COMMAND $<TARGET_FILE:genu> completion zsh > ${genu_written}/_genu
  COMMAND $<TARGET_FILE:genu> completion fish > ${genu_written}/genu.fish VERBATIM)
install(FILES ${genu_written}/genu.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${genu_written}/genu.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME genu)
install(FILES ${genu_written}/_genu DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${genu_written}/genu.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# cpack --config build/CPackConfig.cmake: a .deb of what is built, without building anything again.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(GENU_MAINTAINER "genu developers <genu@localhost>" CACHE STRING "Whom a package names as its maintainer")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME genu)
set(CPACK_PACKAGE_CONTACT "${GENU_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION
    "From bone and cartilage surfaces, ligaments and loads genu finds the poses in which an articular joint balances, and says of each whether it is stable and what it was checked against. The program, the C++ library, the Python package, scenes and documentation.")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, python3, python3-numpy") # to compile against it, to import it
include(CPack)
