# Files inside a program: froe_embed(TARGET FILE...) compiles their bytes in and lists them in
# `cli_embedded_files` (cli/embedded.h) by their names. Files that are not there are left out.
function(froe_embed target)
  set(present "")
  foreach(file ${ARGN})
    if(EXISTS ${file})
      list(APPEND present ${file})
    endif()
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded.c)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed.cmake)
  add_custom_command(OUTPUT ${source}
                     COMMAND ${CMAKE_COMMAND} -DOUTPUT=${source} "-DFILES=${present}" -P ${script}
                     DEPENDS ${present} ${script} VERBATIM)
  target_sources(${target} PRIVATE ${source})
endfunction()
