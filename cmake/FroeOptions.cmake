# What a user may choose.
set(developing OFF) # a checkout, not a tarball and not a part of another project
if(PROJECT_IS_TOP_LEVEL AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  set(developing ON)
endif()

foreach(part IO DRAW CLI)
  set(FROE_${part} AUTO CACHE STRING "Build this part: ON, OFF, or AUTO: if what it needs is found")
  set_property(CACHE FROE_${part} PROPERTY STRINGS AUTO ON OFF)
endforeach()
option(FROE_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(FROE_BENCH "Build the benches" OFF)
option(FROE_FUZZ "Build the fuzzers with libFuzzer (clang)" OFF)
option(FROE_WERROR "Warnings are errors" ${developing})
option(FROE_MPI "Build froe-mpi, which needs an MPI" OFF)
option(FROE_NATIVE "Use every instruction this machine has" OFF)
option(FROE_COVERAGE "Count the lines that tests run" OFF)
option(FROE_LINK_ALL "Link the program with all libraries, instead of opening froe-io and froe-draw when needed" OFF)
set(FROE_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo" FORCE)
endif()

# The commit for `froe --version`: of this very repository, or nothing in a tarball.
set(FROE_COMMIT "")
find_program(GIT git)
if(GIT AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT} describe --always --dirty --abbrev=12 --exclude=*
                  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  OUTPUT_VARIABLE FROE_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
