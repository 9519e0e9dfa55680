/* spool.h: files that can be read only once, as readers want them: with a name, and from any place. */
#ifndef FROE_CLI_SPOOL_H
#define FROE_CLI_SPOOL_H
#include "files.h"
#include <stdbool.h>

typedef struct cli_spool {
    const char *name;        /**< what messages call the file */
    const char *path;        /**< where to read it */
    char folder[CLI_FOLDER]; /**< made for a copy; "": the file itself is read */
    char copy[4096];
} cli_spool;

/** Standard input ("-"), a pipe or a device is copied into a folder for temporary files, under a name with the
 * extension `format`, which must be given. Other files are left where they are, and must have no `format`. Returns 0,
 * or an exit code after saying why. On success cli_spool_free() must follow, and `path` must last until then. */
int cli_spool_open(const char *path, const char *format, cli_spool *out);
/** Removes the copy. */
void cli_spool_free(cli_spool *spool);
#endif
