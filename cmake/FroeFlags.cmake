# Flags for everything. Two of them are part of the mathematics:
#   -ffp-contract=off  the filters' error bounds assume that every + - * / rounds once, to
#                      nearest, in double; a fused a*b+c would also make trees differ between
#                      compilers. (Where a fused operation is wanted, the code says fma().)
#   no -ffast-math     and nothing it implies, for the same reason.
# -fno-math-errno changes no result: it lets sqrt() be one instruction.
# The machine is the baseline of its architecture unless FROE_NATIVE is ON. On baseline
# x86-64 fma() is a call that the C library answers with the instruction where there is one,
# in software otherwise: equal bits, and rare, because only what the first filter
# leaves open gets there.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_POSITION_INDEPENDENT_CODE ON) # one set of objects serves both kinds of library
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_compile_definitions($<$<COMPILE_LANGUAGE:C>:_POSIX_C_SOURCE=200809L>)
add_compile_options(-ffp-contract=off -fno-math-errno)
add_compile_options("$<$<COMPILE_LANGUAGE:C>:-Wall;-Wextra;-Wshadow;-Wconversion;-Wno-sign-conversion;-Wstrict-prototypes;-Wmissing-prototypes>")
if(FROE_WERROR)
  add_compile_options(-Werror)
endif()
if(FROE_NATIVE)
  add_compile_options(-march=native)
endif()
if(FROE_SANITIZE)
  # -g1: lines, which is what reports name. They take a fifth less time to compile than all that debuggers want.
  add_compile_options(-fsanitize=${FROE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=${FROE_SANITIZE})
endif()
if(FROE_COVERAGE) # by clang; FroeCoverage.cmake says what is counted
  add_link_options(-fprofile-instr-generate)
endif()
if(FROE_FUZZ)
  # clang, unlike gcc, objects to NULL + 0, which is where an empty array begins.
  add_compile_options(-fsanitize=fuzzer-no-link -fno-sanitize=pointer-overflow)
endif()
