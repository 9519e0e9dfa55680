/* json.h: lines of results, as README.md of this folder describes them. */
#ifndef FROE_BENCH_JSON_H
#define FROE_BENCH_JSON_H
#include <stddef.h>

typedef struct json_result {
    const char *work, *scene;
    size_t objects;
    const char *program, *measure;
    const double *values; /**< one a round; NULL: failed, as `note` says */
    size_t count;
    const char *note; /**< or NULL */
} json_result;

/** Prints a line to standard output. Texts hold nothing that JSON escapes. */
void json_line(const json_result *result);
#endif
