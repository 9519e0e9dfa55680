# make install, find_package(froe), pkg-config froe.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/froe)

# froe_install(NAME): libraries of one part and its header
function(froe_install name header)
  set(targets ${name} ${name}_static)
  if(FROE_KINDS STREQUAL "static")
    list(REMOVE_ITEM targets ${name})
  elseif(FROE_KINDS STREQUAL "shared")
    list(REMOVE_ITEM targets ${name}_static)
  endif()
  install(TARGETS ${targets} EXPORT froe
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES include/froe/${header}.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/froe)
endfunction()

# The prefix is where the file lies, so that an installation can be moved or staged.
if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR})
  set(PC_PREFIX ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  set(PC_PREFIX "\${pcfiledir}/${PC_PREFIX}")
endif()

# froe_pkgconfig(FILE DESCRIPTION REQUIRES REQUIRES_PRIVATE LIBS_PRIVATE)
function(froe_pkgconfig file description requires requires_private libs_private)
  set(PC_NAME ${file})
  set(PC_DESCRIPTION ${description})
  set(PC_REQUIRES ${requires})
  set(PC_REQUIRES_PRIVATE ${requires_private})
  set(PC_LIBS_PRIVATE ${libs_private})
  if(FROE_KINDS STREQUAL "static") # nothing is private
    set(PC_REQUIRES "${requires} ${requires_private}")
    set(PC_LIBS ${libs_private})
  endif()
  configure_file(cmake/froe.pc.in ${file}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${file}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

froe_install(froe froe)
install(FILES include/froe/query.h include/froe/view.h include/froe/kinetic.h include/froe/measure.h include/froe/formats.h
              include/froe/render.h include/froe/arrays.h include/froe/shards.h include/froe/shard_parts.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/froe)
froe_pkgconfig(froe "${PROJECT_DESCRIPTION}" "" "" "-lm -pthread")
if(FROE_HAS_IO)
  froe_install(froe_io io)
  froe_pkgconfig(froe-io "Readers of maps and models for froe" "froe" "gdal assimp expat" "-lm")
endif()
if(FROE_HAS_DRAW)
  froe_install(froe_draw draw)
  froe_pkgconfig(froe-draw "Pictures of froe's partitions" "froe" "cairo" "-lm")
endif()
if(FROE_HAS_CLI)
  install(TARGETS froe_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(NOT CMAKE_CROSSCOMPILING)
    set(scripts ${PROJECT_BINARY_DIR}/completions)
    install(FILES ${manual_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(FILES ${scripts}/froe.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME froe)
    install(FILES ${scripts}/froe.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _froe)
    install(FILES ${scripts}/froe.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  endif()
endif()

install(EXPORT froe NAMESPACE froe:: FILE froeTargets.cmake DESTINATION ${package_dir})
configure_package_config_file(cmake/froeConfig.cmake.in froeConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(froeConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/froeConfig.cmake ${PROJECT_BINARY_DIR}/froeConfigVersion.cmake
        DESTINATION ${package_dir})
