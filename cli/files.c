/* files.c: files written as a whole, and files within the program. */
#include "files.h"
#include "exit.h"
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int fail(const char *path, int error) {
    return cli_fail(CLI_RESOURCES, path, "%s", error ? strerror(error) : "cannot be written");
}

/* Writes and closes; 0 or what went wrong. */
static int write_all(const char *path, cli_write_fn *fn, const void *user) {
    FILE *out = fopen(path, "w");
    if (!out) return errno;
    errno = 0;
    fn(out, user);
    const bool written = !ferror(out);
    if (fclose(out) == 0 && written) return 0;
    return errno ? errno : EIO;
}

int cli_write_file(const char *path, cli_write_fn *fn, const void *user) {
    struct stat there;
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode)) {
        const int error = S_ISDIR(there.st_mode) ? EISDIR : write_all(path, fn, user);
        return error ? fail(path, error) : 0;
    }
    const size_t size = strlen(path) + sizeof ".part";
    char *beside = malloc(size);
    if (!beside) return cli_fail(CLI_RESOURCES, NULL, "out of memory");
    snprintf(beside, size, "%s.part", path);
    int error = write_all(beside, fn, user);
    if (!error && rename(beside, path) != 0) error = errno;
    if (error) remove(beside);
    free(beside);
    return error ? fail(path, error) : 0;
}

const cli_embedded *cli_embedded_named(const char *name) {
    for (const cli_embedded *file = cli_embedded_files; file->name; file++)
        if (strcmp(file->name, name) == 0) return file;
    return NULL;
}
