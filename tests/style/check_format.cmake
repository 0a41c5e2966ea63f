# cmake -D CLANG_FORMAT=... -D ROOT=... -P check_format.cmake: every source must be as .clang-format would write it.
# To mend: clang-format -i FILE.
if(NOT CLANG_FORMAT)
  message("style_format skipped: clang-format 14 was not found (Debian package clang-format-14)")
  return()
endif()
file(GLOB_RECURSE files ${ROOT}/src/*.h ${ROOT}/src/*.cpp ${ROOT}/tools/*.h ${ROOT}/tools/*.cpp ${ROOT}/tests/*.h
     ${ROOT}/tests/*.cpp ${ROOT}/python/*.h ${ROOT}/python/*.cpp ${ROOT}/examples/*.cpp)
if(NOT files)
  message(FATAL_ERROR "no sources under ${ROOT}")
endif()
execute_process(COMMAND ${CLANG_FORMAT} --style=file --dry-run -Werror ${files} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "mend with: ${CLANG_FORMAT} -i FILE")
endif()
