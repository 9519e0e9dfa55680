# Fuzzers: fuzz/fuzz_NAME.c. With libFuzzer (FROE_FUZZ, preset fuzz) they search. With sanitizers (FROE_SANITIZE) each is a
# test that replays fuzz/corpus/NAME and the seeds that fuzz/seeds.c makes during the build, and that fails if these reach
# fewer places of the library than its floor: a corpus that has died says so.

# The library with its internal functions. For replays it is compiled once more, so that it tells where it has been, and
# with the same optimization in every build, so that there is about the same number of places.
function(froe_fuzzed name)
  if(FROE_FUZZ)
    add_library(froe_fuzzed_${name} STATIC $<TARGET_OBJECTS:froe_${name}>)
  else()
    get_target_property(sources froe_${name} SOURCES)
    add_library(froe_fuzzed_${name} STATIC ${sources})
    target_compile_options(froe_fuzzed_${name} PRIVATE -O1 -fsanitize-coverage=trace-pc)
    foreach(property INCLUDE_DIRECTORIES COMPILE_DEFINITIONS)
      get_target_property(value froe_${name} ${property})
      if(value)
        set_target_properties(froe_fuzzed_${name} PROPERTIES ${property} "${value}")
      endif()
    endforeach()
  endif()
  target_include_directories(froe_fuzzed_${name} PUBLIC include)
  target_link_libraries(froe_fuzzed_${name} PUBLIC $<TARGET_PROPERTY:froe_${name},LINK_LIBRARIES>)
endfunction()

froe_fuzzed(core)
froe_fuzzed(input)
target_sources(froe_fuzzed_core PRIVATE $<TARGET_OBJECTS:froe_support>)
target_link_libraries(froe_fuzzed_core PUBLIC froe_fuzzed_input)
target_link_libraries(froe_fuzzed_input PUBLIC froe_fuzzed_core)

add_executable(fuzz_seeds fuzz/seeds.c tests/support/samples.c)
target_include_directories(fuzz_seeds PRIVATE src tests ${PROJECT_SOURCE_DIR})
target_link_libraries(fuzz_seeds PRIVATE froe_core froe_input froe_support) # the objects themselves: small trees need internal settings
set(seeds ${PROJECT_BINARY_DIR}/fuzz/seeds)
add_custom_command(OUTPUT ${seeds}.made
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${seeds}
  COMMAND fuzz_seeds ${seeds}
  COMMAND ${CMAKE_COMMAND} -E touch ${seeds}.made
  DEPENDS fuzz_seeds VERBATIM COMMENT "Seeds for the fuzzers")
add_custom_target(seeds ALL DEPENDS ${seeds}.made)

# froe_fuzzer(NAME FLOOR)
function(froe_fuzzer name floor)
  set(target fuzz_${name})
  add_executable(${target} fuzz/fuzz_${name}.c fuzz/support.c fuzz/ask.c fuzz/look.c)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/fuzz)
  target_include_directories(${target} PRIVATE src tests ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PRIVATE froe_fuzzed_core)
  if(FROE_FUZZ)
    target_link_options(${target} PRIVATE -fsanitize=fuzzer)
  else()
    target_sources(${target} PRIVATE fuzz/replay.c)
    froe_test(fuzz ${name} ${target} ${floor} ${PROJECT_SOURCE_DIR}/fuzz/corpus/${name} ${seeds}/${name})
  endif()
endfunction()

froe_fuzzer(open 6500)
froe_fuzzer(scene 6400)
froe_fuzzer(read 900)
froe_fuzzer(motion 850)
froe_fuzzer(shards 150)
froe_fuzzer(folder 6000)
froe_fuzzer(poses 1000)
froe_fuzzer(space 3500)

# The parser of command lines, without the program.
if(FROE_HAS_CLI)
  froe_fuzzer(options 0)
  target_sources(fuzz_options PRIVATE cli/args/options.c)
  target_include_directories(fuzz_options PRIVATE cli)
  target_link_libraries(fuzz_options PRIVATE PkgConfig::JANSSON)
endif()

# What GDAL and assimp hand over.
if(TARGET froe_io_core)
  froe_fuzzed(io_core)
  target_link_libraries(froe_fuzzed_io_core PUBLIC froe_fuzzed_input froe_fuzzed_core)
  froe_fuzzer(import 1300)
  target_link_libraries(fuzz_import PRIVATE froe_fuzzed_io_core)
endif()

# Beside an oracle, which needs GMP.
find_package(PkgConfig)
pkg_check_modules(GMP IMPORTED_TARGET GLOBAL gmp)
if(GMP_FOUND)
  froe_fuzzer(kinetic 3300)
  target_sources(fuzz_kinetic PRIVATE tests/oracle/present.c)
  target_link_libraries(fuzz_kinetic PRIVATE PkgConfig::GMP)
endif()
