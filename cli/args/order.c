/* order.c: one number a line. What the numbers mean is for the library to check. */
#include "args/order.h"
#include "exit.h"
#include "support/array.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* To the end of a line of which only the beginning was read. */
static void pass_line(FILE *file, bool whole) {
    while (!whole) {
        const int c = fgetc(file);
        whole = c == '\n' || c == EOF;
    }
}

int cli_read_order(const char *path, cli_order *out) {
    const froe_allocator alloc = support_allocator(NULL);
    ARRAY(uint32_t) ids = {0};
    char line[64];
    int code = 0;
    *out = (cli_order){NULL, 0};
    FILE *file = fopen(path, "r");
    if (!file) return cli_fail_file(CLI_INPUT, path, "read");
    for (size_t number = 1; !code && fgets(line, sizeof line, file); number++) {
        const bool whole = strchr(line, '\n') || feof(file);
        const char *word = line + strspn(line, " \t"), *behind = word + strcspn(word, " \t\r\n");
        const char *rest = behind + strspn(behind, " \t\r\n");
        if (*word == '#' || *rest == '#') pass_line(file, whole);
        if (*word == '#' || (word == behind && whole)) continue;
        /* A whole number below 2^32 - 1, and nothing else but a comment. */
        char *end;
        errno = 0;
        const uintmax_t id = strtoumax(word, &end, 10);
        const bool alone = *rest == '#' || (!*rest && whole);
        if (!alone || *word < '0' || *word > '9' || end != behind || errno || id >= UINT32_MAX)
            code = cli_fail(CLI_INPUT, path, "line %zu: It is not one object id.", number);
        else if (!array_push(&alloc, &ids, (uint32_t)id))
            code = cli_fail_memory();
    }
    if (!code && ferror(file)) code = cli_fail_file(CLI_INPUT, path, "read");
    fclose(file);
    if (!code && !ids.count) code = cli_fail(CLI_INPUT, path, "The file holds no object ids.");
    if (code)
        array_free(&alloc, &ids);
    else
        *out = (cli_order){ids.data, ids.count};
    return code;
}
