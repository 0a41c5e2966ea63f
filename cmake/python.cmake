# The Python package genu: build/python/genu, to be used with PYTHONPATH=build/python, and what is installed. Where Python,
# numpy or pybind11 is not there it is left out, and says so.
#
# A package of Debian is for Debian's own Python; set GENU_PYTHON_EXECUTABLE for another one.
set(genu_has_python OFF)
if(NOT GENU_PYTHON)
  message(STATUS "Python package: left out (GENU_PYTHON=OFF)")
  return()
endif()
find_program(GENU_PYTHON_EXECUTABLE python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(GENU_PYTHON_EXECUTABLE python3)
set(Python_EXECUTABLE ${GENU_PYTHON_EXECUTABLE})
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
find_package(pybind11 2.10 QUIET CONFIG)
if(NOT Python_FOUND OR NOT pybind11_FOUND)
  message(STATUS "Python package: left out, it needs Python 3.9 with its headers, numpy and pybind11 2.10 "
                 "(Debian: python3-dev python3-numpy pybind11-dev)")
  return()
endif()
set(genu_has_python ON)
message(STATUS "Python package: for ${Python_EXECUTABLE} (${Python_VERSION})")

file(GLOB genu_python_sources CONFIGURE_DEPENDS python/bindings/*.cpp)
pybind11_add_module(genu_python MODULE NO_EXTRAS ${genu_python_sources})
set(genu_python_folder ${PROJECT_BINARY_DIR}/python/genu)
set_target_properties(genu_python PROPERTIES OUTPUT_NAME _genu LIBRARY_OUTPUT_DIRECTORY ${genu_python_folder}
                      INSTALL_RPATH "$ORIGIN/../../..")
target_include_directories(genu_python PRIVATE src)
target_compile_definitions(genu_python PRIVATE GENU_VERSION="${PROJECT_VERSION}")
target_link_libraries(genu_python PRIVATE genu_library genu_options)
add_dependencies(installed_files genu_python)

# lib/python3/dist-packages is where Debian's Python looks in /usr; libgenu.so is three folders above the package.
set(GENU_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "Where the Python package is installed, below the prefix")
file(GLOB genu_python_files CONFIGURE_DEPENDS python/genu/*.py python/genu/*.pyi python/genu/py.typed)
foreach(file ${genu_python_files})
  get_filename_component(name ${file} NAME)
  configure_file(${file} ${genu_python_folder}/${name} COPYONLY)
endforeach()
install(TARGETS genu_python DESTINATION ${GENU_PYTHON_FOLDER}/genu)
install(FILES ${genu_python_files} DESTINATION ${GENU_PYTHON_FOLDER}/genu)
