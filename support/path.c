/* path.c: endings of names, in lower case, and names that are of no files. */
#include "support/path.h"
#include <string.h>
#include <sys/stat.h>

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

support_extension support_path_extension(const char *path) {
    support_extension extension = {""};
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash + 1 : path, '.');
    if (!dot || strlen(dot + 1) >= sizeof extension.text) return extension;
    for (size_t i = 0; dot[i + 1]; ++i) extension.text[i] = lower(dot[i + 1]);
    return extension;
}

bool support_path_is_beyond(const char *path) {
    struct stat about;
    return !strncmp(path, "/vsi", 4) || (!stat(path, &about) && S_ISDIR(about.st_mode));
}

bool support_equal_nocase(const char *a, const char *b) {
    while (*a && lower(*a) == lower(*b)) ++a, ++b;
    return !*a && !*b;
}
