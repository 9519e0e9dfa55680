/* order.c: one number a line. What the numbers mean is for the library to check. */
#include "args/order.h"
#include "exit.h"
#include "support/array.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int cli_read_order(const char *path, cli_order *out) {
    const froe_allocator alloc = support_allocator(NULL);
    ARRAY(uint32_t) ids = {0};
    char *line = NULL;
    size_t room = 0;
    int code = 0;
    *out = (cli_order){NULL, 0};
    FILE *file = fopen(path, "r");
    if (!file) return cli_fail_file(CLI_INPUT, path, "read");
    ssize_t length;
    for (size_t number = 1; !code && (length = getline(&line, &room, file)) >= 0; number++) {
        static const char blanks[] = " \t\r\n";
        const char *word = line + strspn(line, blanks), *behind = word + strcspn(word, blanks);
        const char *rest = behind + strspn(behind, blanks), *last = line + length;
        if (word == last || *word == '#') continue;
        /* A whole number below 2^32 - 1, and nothing else but a comment. */
        char *end;
        errno = 0;
        const uintmax_t id = strtoumax(word, &end, 10);
        const bool alone = rest == last || *rest == '#';
        if (!alone || *word < '0' || *word > '9' || end != behind || errno || id >= UINT32_MAX)
            code = cli_fail(CLI_INPUT, path, "line %zu: It is not one object id.", number);
        else if (!array_push(&alloc, &ids, (uint32_t)id))
            code = cli_fail_memory();
    }
    if (!code && ferror(file)) code = cli_fail_file(CLI_INPUT, path, "read");
    if (!code && !feof(file)) code = cli_fail_memory();
    free(line);
    fclose(file);
    if (!code && !ids.count) code = cli_fail(CLI_INPUT, path, "The file holds no object ids.");
    if (code)
        array_free(&alloc, &ids);
    else
        *out = (cli_order){ids.data, ids.count};
    return code;
}
