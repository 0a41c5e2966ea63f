# genu_text_source(TARGET FILE FUNCTION HEADER): compiles a text file into TARGET as std::string genu::FUNCTION(), which
# HEADER declares. Run as a script (-DTEXT=... -DFUNCTION=... -DHEADER=... -DOUT=...), it writes that source, as string
# literals no longer than compilers must take.
if(CMAKE_SCRIPT_MODE_FILE)
  set(longest 15000)
  file(READ ${TEXT} text)
  set(source "#include \"${HEADER}\"\n\nnamespace genu {\n\nstd::string ${FUNCTION}() {\n  std::string text;\n")
  string(LENGTH "${text}" left)
  while(left GREATER 0)
    set(piece ${longest})
    if(left LESS piece)
      set(piece ${left})
    endif()
    string(SUBSTRING "${text}" 0 ${piece} head)
    string(SUBSTRING "${text}" ${piece} -1 text)
    string(APPEND source "  text += R\"~(${head})~\";\n")
    string(LENGTH "${text}" left)
  endwhile()
  string(APPEND source "  return text;\n}\n\n}  // namespace genu\n")
  file(WRITE ${OUT} "${source}")
  return()
endif()

set(genu_text_source_script ${CMAKE_CURRENT_LIST_FILE})
function(genu_text_source target text function header)
  set(source ${PROJECT_BINARY_DIR}/${function}.cpp)
  add_custom_command(OUTPUT ${source} DEPENDS ${PROJECT_SOURCE_DIR}/${text} ${genu_text_source_script} VERBATIM
                     COMMAND ${CMAKE_COMMAND} -DTEXT=${PROJECT_SOURCE_DIR}/${text} -DFUNCTION=${function} -DHEADER=${header}
                             -DOUT=${source} -P ${genu_text_source_script})
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${source})
endfunction()
