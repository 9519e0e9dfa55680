/* support.c: see support.h. */
#include "support.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

double fuzz_double(fuzz_bytes *bytes) {
    static const double odd[] = {0.5,       -0.0, 1e308,   -1e308, 0x1p-1074,
                                 0x1p-1022, 0.1,  1.0 / 3, 1e16,   0x1.fffffffffffffp0};
    const uint8_t what = fuzz_byte(bytes);
    if (what < 0xe0) return (double)(what % 16) - 8;
    if (what < 0xf0) return odd[what % (sizeof odd / sizeof *odd)];
    uint64_t bits = 0;
    double x;
    for (int i = 0; i < 8; i++) bits = bits << 8 | fuzz_byte(bytes);
    memcpy(&x, &bits, sizeof x);
    return x;
}

void fuzz_complain(const char *what, const froe_diagnostic *why) {
    fprintf(stderr, "%s: %s: %s\n", what, froe_status_name(why->status), why->message);
    abort();
}

static void give_up(const char *what) {
    perror(what);
    exit(2);
}

void fuzz_file(const char *prefix, const char *suffix, const uint8_t *data, size_t size, char *path, size_t capacity) {
    const char *folder = getenv("TMPDIR");
    snprintf(path, capacity, "%s/froe-fuzz-%ld%s", folder ? folder : ".", (long)getpid(), suffix);
    FILE *file = fopen(path, "wb");
    if (!file) give_up(path);
    fputs(prefix, file);
    fwrite(data, 1, size, file);
    if (fclose(file)) give_up(path);
}
