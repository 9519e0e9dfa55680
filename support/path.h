/* path.h: names of files, and words that are compared without case. */
#ifndef FROE_SUPPORT_PATH_H
#define FROE_SUPPORT_PATH_H
#include <stdbool.h>

/** The extension of a path in lower case, without the dot, "" if there is none (or none that fits). */
typedef struct support_extension {
    char text[16];
} support_extension;
support_extension support_path_extension(const char *path);
/** Is it no file, but what a reader of maps opens: a folder, or a name in the virtual file systems of GDAL? */
bool support_path_is_beyond(const char *path);
bool support_equal_nocase(const char *a, const char *b); /**< ASCII letters only */
#endif
