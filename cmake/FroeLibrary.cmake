# How a folder becomes a shared and a static library that show their public symbols only.

# All C files below a folder.
function(froe_sources out folder)
  file(GLOB_RECURSE found CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${folder}/*.c)
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# Public headers, for targets that see nothing else.
add_library(froe_public INTERFACE)
target_include_directories(froe_public INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)

# A static library cannot hide symbols by visibility alone: archives are searched symbol by
# symbol, and a hidden name of ours would clash with the same name in the user's program.
# So all objects are linked into one, whose hidden symbols then become local. Instrumented
# objects are left as they are: sanitizers and coverage need their own symbols.
set(FROE_LOCALIZE OFF)
if(CMAKE_OBJCOPY AND NOT APPLE AND NOT FROE_SANITIZE AND NOT FROE_COVERAGE AND NOT FROE_FUZZ)
  set(FROE_LOCALIZE ON)
endif()

# Both kinds of libraries, or the one that BUILD_SHARED_LIBS asks for.
set(FROE_KINDS shared static)
if(DEFINED BUILD_SHARED_LIBS)
  set(FROE_KINDS static)
  if(BUILD_SHARED_LIBS)
    set(FROE_KINDS shared)
  endif()
endif()

function(froe_archive_objects out core)
  set(objects "")
  foreach(part ${core} ${ARGN})
    list(APPEND objects $<TARGET_OBJECTS:${part}>)
  endforeach()
  if(NOT FROE_LOCALIZE)
    set(${out} ${objects} PARENT_SCOPE)
    return()
  endif()
  set(object ${PROJECT_BINARY_DIR}/${core}.o)
  add_custom_command(
    OUTPUT ${object}
    COMMAND ${CMAKE_LINKER} -r -o ${object} ${objects}
    COMMAND ${CMAKE_OBJCOPY} --localize-hidden ${object}
    DEPENDS ${core} ${ARGN} ${objects}
    COMMAND_EXPAND_LISTS VERBATIM
    COMMENT "Hiding the internal symbols of ${core}")
  set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  set(${out} ${object} PARENT_SCOPE)
endfunction()

# froe_libraries(NAME FILE [NEEDS...] [WITH OBJECTS...]): from the objects NAME_core, froe_support and OBJECTS the targets
# NAME (shared) and NAME_static, called libFILE, that link to the shared or static NEEDS.
function(froe_libraries name file)
  cmake_parse_arguments(PARSE_ARGV 2 own "" "" "WITH")
  add_library(${name} SHARED)
  foreach(part ${name}_core froe_support ${own_WITH})
    target_sources(${name} PRIVATE $<TARGET_OBJECTS:${part}>)
  endforeach()
  froe_archive_objects(objects ${name}_core froe_support ${own_WITH})
  add_library(${name}_static STATIC ${objects})
  set_target_properties(${name} ${name}_static PROPERTIES OUTPUT_NAME ${file} LINKER_LANGUAGE C)
  if(FROE_LOCALIZE) # a part that calls what another part hides must not link
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  set_target_properties(${name} PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR} EXPORT_NAME ${file})
  set_target_properties(${name}_static PROPERTIES EXPORT_NAME ${file}-static)
  get_target_property(libraries ${name}_core LINK_LIBRARIES)
  list(REMOVE_ITEM libraries froe_public)
  target_link_libraries(${name} PRIVATE ${libraries})
  target_link_libraries(${name}_static PRIVATE ${libraries})
  foreach(need ${own_UNPARSED_ARGUMENTS})
    target_link_libraries(${name} PUBLIC ${need})
    target_link_libraries(${name}_static PUBLIC ${need}_static)
  endforeach()
  if(NOT shared IN_LIST FROE_KINDS)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  elseif(NOT static IN_LIST FROE_KINDS)
    set_target_properties(${name}_static PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  foreach(target ${name} ${name}_static)
    target_include_directories(${target} PUBLIC
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  endforeach()
  add_library(froe::${file} ALIAS ${name})
  add_library(froe::${file}-static ALIAS ${name}_static)
endfunction()
