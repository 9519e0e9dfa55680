# froe-mpi: folders of shards by the processes of an MPI program, -DFROE_MPI=ON. Each implementation of MPI has its own
# binary interface, so the library is static, and what uses it is built with the same one:
# -DMPI_C_COMPILER=mpicc.mpich chooses.
find_package(MPI REQUIRED COMPONENTS C)
froe_sources(mpi_sources mpi)
list(REMOVE_ITEM mpi_sources mpi/program.c)
add_library(froe_mpi STATIC ${mpi_sources} $<TARGET_OBJECTS:froe_support>)
set_target_properties(froe_mpi PROPERTIES OUTPUT_NAME froe-mpi)
target_include_directories(froe_mpi PUBLIC mpi PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(froe_mpi PUBLIC froe MPI::MPI_C)
add_executable(froe_mpi_program mpi/program.c)
set_target_properties(froe_mpi_program PROPERTIES OUTPUT_NAME froe-mpi RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin
                                                  INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
target_include_directories(froe_mpi_program PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(froe_mpi_program PRIVATE froe_mpi)
install(TARGETS froe_mpi_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(FROE_TESTS)
  add_executable(froe_mpi_alone tests/mpi/alone.c)
  set_target_properties(froe_mpi_alone PROPERTIES OUTPUT_NAME froe-alone RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  target_link_libraries(froe_mpi_alone PRIVATE froe)
  file(GLOB transcripts CONFIGURE_DEPENDS tests/mpi/*.test)
  foreach(transcript ${transcripts})
    get_filename_component(name ${transcript} NAME_WE)
    froe_test(mpi ${name} ${PROJECT_SOURCE_DIR}/scripts/transcript ${transcript})
    set_tests_properties(mpi/${name} PROPERTIES ENVIRONMENT # Open MPI starts more ranks than cores, and as root, if told to
      "FROE_BIN=${PROJECT_BINARY_DIR}/bin;MPIRUN=${MPIEXEC_EXECUTABLE};OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1")
  endforeach()
endif()
