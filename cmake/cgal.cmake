# CGAL is asked for here alone: with GENU_WITH_CGAL=OFF it need not be installed.
if(GENU_WITH_CGAL)
  find_package(CGAL 5.5 REQUIRED)
endif()

# genu_cgal_sources(TARGET [LIBRARIES ...] SOURCES ...): compiles the sources of TARGET that include CGAL apart from
# the others. CGAL asks for -frounding-math; this way no other file is compiled differently with CGAL than without.
function(genu_cgal_sources target)
  cmake_parse_arguments(arg "" "" "LIBRARIES;SOURCES" ${ARGN})
  add_library(${target}_cgal OBJECT ${arg_SOURCES})
  target_link_libraries(${target}_cgal PRIVATE ${arg_LIBRARIES} genu_options CGAL::CGAL)
  target_include_directories(${target}_cgal PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
  target_compile_definitions(${target}_cgal PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS>
                             GENU_WITH_CGAL CGAL_EIGEN3_ENABLED)
  set_target_properties(${target}_cgal PROPERTIES UNITY_BUILD OFF) # each is large
  get_target_property(others ${target} SOURCES)
  list(REMOVE_ITEM others ${arg_SOURCES})
  set_target_properties(${target} PROPERTIES SOURCES "${others}")
  target_link_libraries(${target} PRIVATE ${target}_cgal)
endfunction()
