/* order.c: one number a line. The library checks an order, too, but knows neither the file nor the line. */
#include "args/order.h"
#include "exit.h"
#include "support/alloc.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ids that were read, and of each object whether its own is among them. */
typedef struct ids {
    uint32_t *list;
    bool *seen;
    size_t count, objects;
} ids;

/* A whole number, and nothing else but a comment. Exit code. */
static int take_line(ids *all, const char *path, size_t number, const char *line, size_t length) {
    static const char blanks[] = " \t\r\n";
    const char *word = line + strspn(line, blanks), *behind = word + strcspn(word, blanks);
    const char *rest = behind + strspn(behind, blanks), *last = line + length;
    if (word == last || *word == '#') return 0;
    char *end;
    errno = 0;
    const uintmax_t id = strtoumax(word, &end, 10);
    const bool alone = rest == last || *rest == '#';
    if (!alone || *word < '0' || *word > '9' || end != behind || errno)
        return cli_fail(CLI_INPUT, path, "line %zu: It is not one object id.", number);
    if (id >= all->objects) return cli_fail(CLI_INPUT, path, "line %zu: There is no object %ju.", number, id);
    if (all->seen[id]) return cli_fail(CLI_INPUT, path, "line %zu: Object %ju is named twice.", number, id);
    all->seen[id] = true;
    all->list[all->count++] = (uint32_t)id;
    return 0;
}

static int take_lines(ids *all, const char *path) {
    char *line = NULL;
    size_t room = 0;
    ssize_t length;
    int code = 0;
    FILE *file = fopen(path, "r");
    if (!file) return cli_fail_file(CLI_INPUT, path, "read");
    for (size_t number = 1; !code && (length = getline(&line, &room, file)) >= 0; number++)
        code = take_line(all, path, number, line, (size_t)length);
    if (!code && ferror(file)) code = cli_fail_file(CLI_INPUT, path, "read");
    if (!code && !feof(file)) code = cli_fail_memory();
    free(line);
    fclose(file);
    return code;
}

int cli_read_order(const char *path, size_t objects, uint32_t **out) {
    const froe_allocator alloc = support_allocator(NULL);
    ids all = {.list = support_calloc(&alloc, objects, sizeof *all.list),
               .seen = support_calloc(&alloc, objects, sizeof *all.seen),
               .objects = objects};
    int code = all.list && all.seen ? take_lines(&all, path) : cli_fail_memory();
    if (!code && all.count < objects)
        code = cli_fail(CLI_INPUT, path, "The file has %zu ids for %zu objects.", all.count, objects);
    free(all.seen);
    *out = all.list;
    return code;
}
