/* replay.c: feeds files, and the files of folders, to a fuzzer without libFuzzer: what once
 * was found stays found, in every ordinary run of the tests. */
#include "support.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static size_t replay(const char *path) {
    FILE *file = fopen(path, "rb");
    struct stat info;
    if (!file || stat(path, &info)) {
        perror(path);
        exit(2);
    }
    const size_t size = (size_t)info.st_size;
    uint8_t *data = malloc(size ? size : 1); /* exactly so much that a sanitizer sees one byte more */
    if (!data || fread(data, 1, size, file) != size) {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(2);
    }
    fclose(file);
    LLVMFuzzerTestOneInput(data, size);
    free(data);
    return 1;
}

static int visible(const struct dirent *entry) {
    return entry->d_name[0] != '.';
}

static size_t replay_folder(const char *path) {
    struct dirent **entries = NULL;
    const int count = scandir(path, &entries, visible, alphasort);
    if (count < 0) return replay(path);
    for (int i = 0; i < count; i++) {
        char name[4096];
        snprintf(name, sizeof name, "%s/%s", path, entries[i]->d_name);
        replay(name);
        free(entries[i]);
    }
    free(entries);
    return (size_t)count;
}

int main(int argc, char **argv) {
    size_t count = 0;
    for (int i = 1; i < argc; i++) count += replay_folder(argv[i]);
    printf("%zu inputs\n", count);
    return count == 0; /* an empty corpus proves nothing */
}
