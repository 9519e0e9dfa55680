/* order.c: one number a line. What the numbers mean is for the library to check. */
#include "args/order.h"
#include "exit.h"
#include "support/array.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

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
        line[strcspn(line, " \t\r\n")] = 0;
        if (whole && (!line[0] || line[0] == '#')) continue;
        /* A whole number below 2^32 - 1 and nothing else. */
        char *end;
        errno = 0;
        const uintmax_t id = strtoumax(line, &end, 10);
        if (!whole || line[0] < '0' || line[0] > '9' || *end || errno || id >= UINT32_MAX)
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
