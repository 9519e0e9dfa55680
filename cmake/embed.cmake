# Writes OUTPUT, a C source that holds the bytes of FILES in TABLE, which HEADER declares. Run by froe_embed().
set(arrays "")
set(entries "")
set(number 0)
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  file(READ ${file} bytes HEX)
  file(SIZE ${file} size)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND arrays "static const unsigned char file${number}[] = {\n${bytes}0};\n")
  string(APPEND entries "    {\"${name}\", file${number}, ${size}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "/* Made by cmake/embed.cmake. */
#include \"${HEADER}\"

${arrays}
const support_embedded ${TABLE}[] = {
${entries}    {0, 0, 0},
};
")
