/* embedded.h: files that the build put into the program (cmake/FroeEmbed.cmake). */
#ifndef FROE_CLI_EMBEDDED_H
#define FROE_CLI_EMBEDDED_H
#include <stddef.h>

typedef struct cli_embedded {
    const char *name;
    const unsigned char *bytes;
    size_t size;
} cli_embedded;
/** Ended by a NULL name. */
extern const cli_embedded cli_embedded_files[];
#endif
