/* order.c: one number a line. What the numbers mean is for the library to check. */
#include "args/order.h"
#include "exit.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int add(cli_order *order, size_t *capacity, uint32_t id) {
    if (order->count == *capacity) {
        size_t larger = *capacity ? 2 * *capacity : 1024;
        uint32_t *ids = realloc(order->ids, larger * sizeof *ids);
        if (!ids) return cli_fail_memory();
        order->ids = ids;
        *capacity = larger;
    }
    order->ids[order->count++] = id;
    return 0;
}

/** A whole number below 2^32 - 1 and nothing else. */
static bool parse_id(const char *text, uint32_t *id) {
    char *end;
    errno = 0;
    uintmax_t value = strtoumax(text, &end, 10);
    *id = (uint32_t)value;
    return text[0] >= '0' && text[0] <= '9' && !*end && !errno && value < UINT32_MAX;
}

static int read_lines(FILE *file, const char *path, cli_order *out) {
    char line[64];
    size_t capacity = 0, number = 0;
    while (fgets(line, sizeof line, file)) {
        uint32_t id;
        number++;
        bool whole = strchr(line, '\n') || feof(file);
        line[strcspn(line, " \t\r\n")] = 0;
        if (whole && (!line[0] || line[0] == '#')) continue;
        if (!whole || !parse_id(line, &id))
            return cli_fail(CLI_INPUT, path, "line %zu: It is not one object id.", number);
        int code = add(out, &capacity, id);
        if (code) return code;
    }
    return ferror(file) ? cli_fail_file(CLI_INPUT, path, "read") : 0;
}

int cli_read_order(const char *path, cli_order *out) {
    *out = (cli_order){NULL, 0};
    FILE *file = fopen(path, "r");
    if (!file) return cli_fail_file(CLI_INPUT, path, "read");
    int code = read_lines(file, path, out);
    fclose(file);
    if (!code && !out->count) code = cli_fail(CLI_INPUT, path, "The file holds no object ids.");
    if (!code) return 0;
    free(out->ids);
    *out = (cli_order){NULL, 0};
    return code;
}
