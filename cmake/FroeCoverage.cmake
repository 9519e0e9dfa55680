# What scripts/coverage counts: branches of everything but the tests, by clang. Counters are not atomic, because tests
# would take eight times as long: threads that meet at a counter lose a count, and may make a way seem taken.
# Counters may stand in a mapped file of counts (%c in FroeTests.cmake): what is killed, or ends by _exit(), leaves its
# counts, too.
set(coverage_flags -fprofile-instr-generate -fcoverage-mapping "SHELL:-mllvm -runtime-counter-relocation")
foreach(target froe_support froe_input froe_core froe_io_core froe_draw_core froe_cli_linked froe_cli_opened froe_program)
  if(TARGET ${target})
    target_compile_options(${target} PRIVATE ${coverage_flags})
  endif()
endforeach()
# What believes no file: each condition by itself, too.
set(wary ${core_sources})
list(FILTER wary INCLUDE REGEX "^src/tree/(audit/.*|packed/.*_(audit|validate)|open|file|gate|validate)\\.c$")
set_source_files_properties(${wary} PROPERTIES COMPILE_OPTIONS -fcoverage-mcdc)
# Tests share a folder of shards among threads, which run the same lines at the same time. The ways of a branch are
# differences of counters, so a lost count may make a taken way seem not taken: here they are atomic.
set_source_files_properties(${shards_sources} PROPERTIES COMPILE_OPTIONS -fprofile-update=atomic)
