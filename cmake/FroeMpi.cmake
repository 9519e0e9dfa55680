# froe-mpi: folders of shards by the processes of an MPI program, -DFROE_MPI=ON. Each implementation of MPI has its own
# binary interface, so the library is static, and what uses it is built with the same one:
# -DMPI_C_COMPILER=mpicc.mpich chooses.
find_package(MPI REQUIRED COMPONENTS C)
get_filename_component(mpi_kind "${MPI_C_COMPILER}" LAST_EXT) # .mpich, where several are installed
find_program(FROE_MPIRUN NAMES mpirun${mpi_kind} ${MPIEXEC_EXECUTABLE})
froe_sources(mpi_sources mpi)
set(mpi_program_sources mpi/program.c mpi/ask.c mpi/output.c mpi/query.c)
list(REMOVE_ITEM mpi_sources ${mpi_program_sources})
set(FROE_MPI_CORE "" CACHE FILEPATH "a libfroe.so that is built already, for froe-mpi to be linked to, with bin/froe beside it")
set(mpi_core froe)
set(mpi_bin "${PROJECT_BINARY_DIR}/bin")
if(FROE_MPI_CORE)
  set(mpi_core froe_mpi_core)
  add_library(froe_mpi_core SHARED IMPORTED)
  set_target_properties(froe_mpi_core PROPERTIES IMPORTED_LOCATION ${FROE_MPI_CORE}
                                                 INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/include)
  get_filename_component(core_folder ${FROE_MPI_CORE} DIRECTORY)
  string(APPEND mpi_bin ":${core_folder}/bin")
endif()
add_library(froe_mpi STATIC ${mpi_sources} $<TARGET_OBJECTS:froe_support>)
set_target_properties(froe_mpi PROPERTIES OUTPUT_NAME froe-mpi)
target_include_directories(froe_mpi PUBLIC mpi PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(froe_mpi PUBLIC ${mpi_core} MPI::MPI_C)
function(froe_mpi_program target name)
  add_executable(${target} ${mpi_program_sources} cli/exit.c cli/queries/rows.c cli/queries/answers.c ${ARGN}
                           $<TARGET_OBJECTS:froe_support>)
  target_compile_definitions(${target} PRIVATE CLI_PROGRAM="froe-mpi")
  target_include_directories(${target} PRIVATE cli ${PROJECT_SOURCE_DIR})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin
                                             INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  target_link_libraries(${target} PRIVATE froe_mpi)
endfunction()
froe_mpi_program(froe_mpi_program froe-mpi)
install(TARGETS froe_mpi_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(FROE_TESTS)
  add_executable(froe_mpi_alone tests/mpi/alone.c)
  set_target_properties(froe_mpi_alone PROPERTIES OUTPUT_NAME froe-alone RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  target_link_libraries(froe_mpi_alone PRIVATE ${mpi_core})
  froe_mpi_program(froe_mpi_moments froe-mpi-moments tests/mpi/moments.c)
  foreach(call mpi_rows_read froe_shard_records_add froe_shard_plan_new froe_shard_build froe_shard_draft_sync froe_shard_draft_place
          froe_shards_boxes froe_mpi_begin pwrite flock)
    target_link_options(froe_mpi_moments PRIVATE -Wl,--wrap=${call})
  endforeach()
  file(GLOB transcripts CONFIGURE_DEPENDS tests/mpi/*.test)
  foreach(transcript ${transcripts}) # ranks that wait leave their core to others, also on a machine that is busy
    get_filename_component(name ${transcript} NAME_WE)
    froe_test(mpi ${name} ${PROJECT_SOURCE_DIR}/scripts/transcript ${transcript})
    set_tests_properties(mpi/${name} PROPERTIES ENVIRONMENT # Open MPI starts more ranks than cores, and as root, if told to
      "FROE_BIN=${mpi_bin};MPIRUN=${FROE_MPIRUN};OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1;OMPI_MCA_mpi_yield_when_idle=1")
  endforeach()
endif()
