/* embedded.h: files that the build puts into a program or library (cmake/FroeEmbed.cmake). */
#ifndef FROE_SUPPORT_EMBEDDED_H
#define FROE_SUPPORT_EMBEDDED_H
#include <stddef.h>

typedef struct support_embedded {
    const char *name;
    const unsigned char *bytes;
    size_t size;
} support_embedded;

/** The file of that name, NULL if there is none. `files` is ended by a NULL name. */
const support_embedded *support_embedded_named(const support_embedded *files, const char *name);
#endif
