# Files inside a program or library: froe_embed(TARGET HEADER TABLE FILE...) compiles their bytes in and lists them in
# TABLE, which HEADER declares (support/embedded.h), by their names. Files that are not there are left out.
function(froe_embed target header table)
  set(present "")
  foreach(file ${ARGN})
    if(EXISTS ${PROJECT_SOURCE_DIR}/${file})
      list(APPEND present ${PROJECT_SOURCE_DIR}/${file})
    endif()
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${table}.c)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed.cmake)
  add_custom_command(OUTPUT ${source}
                     COMMAND ${CMAKE_COMMAND} -DOUTPUT=${source} -DHEADER=${header} -DTABLE=${table} "-DFILES=${present}"
                             -P ${script}
                     DEPENDS ${present} ${script} VERBATIM)
  target_sources(${target} PRIVATE ${source})
endfunction()
