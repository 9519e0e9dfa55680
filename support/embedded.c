/* embedded.c: see embedded.h. */
#include "support/embedded.h"
#include <string.h>

const support_embedded *support_embedded_named(const support_embedded *files, const char *name) {
    for (; files->name; files++)
        if (strcmp(files->name, name) == 0) return files;
    return NULL;
}
