# Where froe can be built: each refusal says what is missing, before anything is compiled.
if(NOT CMAKE_C_COMPILER_ID MATCHES "^(GNU|Clang|AppleClang)$")
  message(FATAL_ERROR "froe is exact only as gcc or clang compile it, and this compiler is ${CMAKE_C_COMPILER_ID}: "
                      "set CMAKE_C_COMPILER to one of them.")
endif()
if(WIN32 AND NOT CYGWIN)
  message(FATAL_ERROR "froe needs a POSIX system, which Windows is not: build it for WebAssembly (web/) or in WSL.")
endif()
get_property(sharing GLOBAL PROPERTY TARGET_SUPPORTS_SHARED_LIBS)
if(NOT sharing)
  message(FATAL_ERROR "froe needs a POSIX system with shared libraries, which ${CMAKE_SYSTEM_NAME} is not.")
endif()
include(CheckCSourceCompiles)
check_c_source_compiles("__int128 product; int main(void) { return (int)product; }" FROE_INT128)
if(NOT FROE_INT128)
  message(FATAL_ERROR "froe needs __int128, which gcc and clang have for processors of 64 bits alone: "
                      "build it for one, not for ${CMAKE_SYSTEM_PROCESSOR} with pointers of ${CMAKE_SIZEOF_VOID_P} bytes.")
endif()
check_c_source_compiles("
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <sys/mman.h>
#include <time.h>
int main(void) {
    struct timespec now;
    return clock_gettime(CLOCK_MONOTONIC, &now) || mmap(0, 1, PROT_READ, MAP_PRIVATE, -1, 0) != MAP_FAILED || !pthread_self();
}" FROE_POSIX)
if(NOT FROE_POSIX)
  message(FATAL_ERROR "froe needs POSIX.1-2008 with threads, mmap() and clock_gettime(), and these do not compile here: "
                      "CMakeFiles/CMakeError.log in the build folder tells why.")
endif()
