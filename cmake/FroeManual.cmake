# Man pages and the scripts of shells that complete command lines: the program writes them itself, from the tables of
# its --help.
set(manual_pages "")
if(CMAKE_CROSSCOMPILING)
  return()
endif()

function(froe_manual_page page)
  set(file ${PROJECT_BINARY_DIR}/man/${page}.1)
  add_custom_command(OUTPUT ${file} COMMAND froe_program --manual ${ARGN} > ${file} DEPENDS froe_program VERBATIM)
  set(manual_pages ${manual_pages} ${file} PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/man)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS cli/commands.def)
file(STRINGS cli/commands.def lines REGEX "^FROE_COMMAND")
froe_manual_page(froe)
foreach(line ${lines})
  string(REGEX REPLACE "^FROE_COMMAND\\((.*)\\).*" "\\1" command ${line})
  froe_manual_page(froe-${command} ${command})
endforeach()

file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/completions)
foreach(shell bash zsh fish)
  set(file ${PROJECT_BINARY_DIR}/completions/froe.${shell})
  add_custom_command(OUTPUT ${file} COMMAND froe_program --completion ${shell} > ${file} DEPENDS froe_program VERBATIM)
  list(APPEND completions ${file})
endforeach()
add_custom_target(froe_manual ALL DEPENDS ${manual_pages} ${completions})
