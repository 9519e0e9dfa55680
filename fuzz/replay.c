/* replay.c: feeds files, and the files of folders, to a fuzzer without libFuzzer: what once
 * was found stays found, in every build with sanitizers.
 *
 *     replay FLOOR PATH...     fails if the inputs reach fewer than FLOOR places of the library
 *
 * A place is a basic block of the library as it is compiled for this (-fsanitize-coverage=trace-pc, by gcc and clang
 * alike): each calls __sanitizer_cov_trace_pc() with its own return address. So a corpus that the library has grown
 * away from fails. */
#include "support.h"
#include <dirent.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ------------------------------------------------------------------ places -- */

enum { MOST_PLACES = 1 << 17, FULL = MOST_PLACES / 4 * 3 };

static atomic_uintptr_t places[MOST_PLACES]; /* a hash table, open addressing; 0: free */
static atomic_uint place_count;

void __sanitizer_cov_trace_pc(void);
void __sanitizer_cov_trace_pc(void) {
    const uintptr_t place = (uintptr_t)__builtin_return_address(0);
    size_t at = (size_t)((uint64_t)place * 0x9e3779b97f4a7c15u >> 47);
    for (;; at = (at + 1) % MOST_PLACES) {
        uintptr_t there = atomic_load_explicit(places + at, memory_order_relaxed);
        if (there == place || atomic_load_explicit(&place_count, memory_order_relaxed) > FULL) return;
        if (there == 0 && atomic_compare_exchange_strong(places + at, &there, place)) {
            atomic_fetch_add(&place_count, 1);
            return;
        }
        if (there == place) return;
    }
}

/* ------------------------------------------------------------------ inputs -- */

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
    if (argc < 3) {
        fprintf(stderr, "usage: %s FLOOR PATH...\n", argv[0]);
        return 2;
    }
    const unsigned floor = (unsigned)strtoul(argv[1], NULL, 10);
    for (int i = 2; i < argc; i++) count += replay_folder(argv[i]);
    printf("%zu inputs reach %u places, %u at least are asked for\n", count, place_count, floor);
    return count == 0 || place_count < floor; /* an empty corpus proves nothing */
}
