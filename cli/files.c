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

/* Devices and pipes may serve twice. */
static bool same_file(const char *a, const char *b) {
    struct stat x, y;
    if (!a || !b) return false;
    if (stat(a, &x) != 0 || stat(b, &y) != 0) return strcmp(a, b) == 0;
    return S_ISREG(x.st_mode) && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

int cli_check_outputs(const char *const *inputs, size_t input_count, const char *const *outputs, size_t output_count) {
    for (size_t i = 0; i < output_count; i++) {
        for (size_t k = 0; k < input_count; k++)
            if (same_file(outputs[i], inputs[k]))
                return cli_fail(CLI_USE, outputs[i], "is read as well; what is written needs a file of its own");
        for (size_t k = 0; k < i; k++)
            if (same_file(outputs[i], outputs[k]))
                return cli_fail(CLI_USE, outputs[i], "is to be written twice; each output needs a file of its own");
    }
    return 0;
}

const cli_embedded *cli_embedded_named(const char *name) {
    for (const cli_embedded *file = cli_embedded_files; file->name; file++)
        if (strcmp(file->name, name) == 0) return file;
    return NULL;
}
