# What scripts/coverage counts: branches of everything but the tests, by clang.
# Counters may stand in a mapped file of counts (%c in FroeTests.cmake): what is killed, or ends by _exit(), leaves its
# counts, too.
set(coverage_flags -fprofile-instr-generate -fcoverage-mapping "SHELL:-mllvm -runtime-counter-relocation")
foreach(target froe_support froe_input froe_core froe_io_core froe_draw_core froe_cli_linked froe_cli_opened froe_program)
  if(TARGET ${target})
    target_compile_options(${target} PRIVATE ${coverage_flags})
  endif()
endforeach()
# The ways of a branch are differences of counters. Threads that meet at a counter which is not atomic lose a count, and
# a taken way may seem not taken, or the other way round. With atomic counters everywhere tests would take eight times as
# long, so they are where all branches have to be taken, and in folders of shards, whose tests are many threads.
set(exact ${core_sources})
list(FILTER exact INCLUDE REGEX "^src/(geom|scene|tree|query)/")
set_property(SOURCE ${exact} ${shards_sources} APPEND PROPERTY COMPILE_OPTIONS -fprofile-update=atomic)
# What believes no file: each condition by itself, too.
set(wary ${core_sources})
list(FILTER wary INCLUDE REGEX "^src/tree/(audit/.*|packed/.*_(audit|validate)|open|file|gate|validate)\\.c$")
set_property(SOURCE ${wary} APPEND PROPERTY COMPILE_OPTIONS -fcoverage-mcdc)
