/* version.c: the version, which has its one source in CMakeLists.txt. */
#include <froe/froe.h>

const char *froe_version(void) {
    return FROE_VERSION;
}
