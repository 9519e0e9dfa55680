/* dxf.c: whether the numbers of a DXF file are numbers, and the blocks that are inserted are there. GDAL takes what
 * numbers begin with, and none for 0: so 1,5 is 1. Where a block is not there it inserts nothing.
 *
 *      10            a group: a code, and what it says of the entity; from 10 to 59 and from 210 to 239 a number
 *     1.5
 *
 * What is not of this form, as a binary file, is left to GDAL. */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <stdlib.h>
#include <string.h>

static const char *line_behind(const char *at) {
    at += strcspn(at, "\r\n");
    return at + (at[0] == '\r' && at[1] == '\n' ? 2 : *at != '\0');
}

static bool is_number(const char *at) {
    char *end;
    at += strspn(at, " \t");
    if (strchr("\r\n", *at)) return false; /* the number of another line would be taken */
    (void)support_decimal(at, &end);
    return end != at && strchr("\r\n", end[strspn(end, " \t")]); /* or the text ends */
}

static bool begins_with(const char *at, const char *word) {
    at += strspn(at, " \t");
    return !strncmp(at, word, strlen(word));
}

/* Passes a group: its code, and where what it says begins. False: there is none. */
static bool next_group(const char **at, long *code, const char **says) {
    char *end;
    if (!**at) return false;
    *code = strtol(*at, &end, 10);
    if (end == *at || !strchr(" \t\r\n", *end)) return false;
    *says = line_behind(*at);
    *at = line_behind(*says);
    return true;
}

/* Numbers elsewhere than in entities, and in blocks of these, draw nothing. */
static io_fault find_dxf_fault(const char *text) {
    const char *at = text, *says;
    long code;
    bool begun = false, drawn = false; /* a section, of entities */
    for (size_t line = 2; next_group(&at, &code, &says); line += 2) {
        const bool number = (code >= 10 && code < 60) || (code >= 210 && code < 240);
        if (drawn && number && *says && !is_number(says))
            return (io_fault){"This is not a number with a decimal point.", line, FROE_E_FORMAT};
        if (begun && code == 2) drawn = begins_with(says, "ENTITIES") || begins_with(says, "BLOCKS");
        begun = code == 0 && begins_with(says, "SECTION");
    }
    return (io_fault){.sentence = NULL};
}

/* ---------------------------------------------------------------- blocks -- */

typedef struct dxf_name {
    const char *at;
    size_t length;
} dxf_name;

typedef struct dxf_blocks {
    ARRAY(dxf_name) blocks, inserts; /* their names */
    bool nameless, elsewhere;        /* there is an insert without a name, a block of another drawing */
} dxf_blocks;

static int order_blocks(const void *x, const void *y) {
    const dxf_name *a = x, *b = y;
    const int order = memcmp(a->at, b->at, a->length < b->length ? a->length : b->length);
    return order ? order : (a->length > b->length) - (a->length < b->length);
}

/* Lists the names of blocks and inserts; false: there is no memory. */
static bool list_blocks(formats_sink *sink, const char *at, dxf_blocks *b) {
    enum { REFERENCE = 4 };
    const froe_allocator *alloc = &sink->alloc;
    bool block = false, insert = false, room = true; /* in one, whose name is not yet known */
    bool head = false;                               /* of a block */
    long code;
    for (const char *says; room && next_group(&at, &code, &says);) {
        says += strspn(says, " \t");
        dxf_name name = {says, strcspn(says, "\r\n")};
        while (name.length && strchr(" \t", says[name.length - 1])) name.length--;
        if (code == 0) {
            b->nameless = b->nameless || insert;
            head = block = name.length == strlen("BLOCK") && begins_with(says, "BLOCK");
            insert = name.length == strlen("INSERT") && begins_with(says, "INSERT");
        }
        if (head && code == 70) b->elsewhere = b->elsewhere || strtol(says, NULL, 10) & REFERENCE;
        if (block && code == 2) room = array_push(alloc, &b->blocks, name), block = false;
        if (insert && code == 2) room = array_push(alloc, &b->inserts, name), insert = false;
    }
    return room;
}

/* Of blocks that do not exist, or stand in another drawing, GDAL inserts nothing. */
static froe_status tell_blocks(formats_sink *sink, const char *text) {
    static const char unknown[] = "INSERT of unknown blocks", elsewhere[] = "XREF";
    dxf_blocks b = {.nameless = false};
    const bool room = list_blocks(sink, text, &b);
    bool lost = b.nameless;
    if (b.blocks.count) qsort(b.blocks.data, b.blocks.count, sizeof *b.blocks.data, order_blocks);
    for (size_t i = 0; i < b.inserts.count && !lost; i++)
        lost = !b.blocks.count ||
               !bsearch(b.inserts.data + i, b.blocks.data, b.blocks.count, sizeof *b.blocks.data, order_blocks);
    if (lost) io_leave(sink, unknown, strlen(unknown));
    if (b.elsewhere) io_leave(sink, elsewhere, strlen(elsewhere));
    array_free(&sink->alloc, &b.blocks);
    array_free(&sink->alloc, &b.inserts);
    return room ? FROE_OK : support_fail_memory(sink->diag);
}

froe_status io_dxf_check(const formats_source *source, formats_sink *sink) {
    formats_text text = {0};
    froe_status status = formats_load(source, sink, true, &text);
    if (!status) {
        const io_fault fault = find_dxf_fault(text.data);
        status = io_text_refuse(source, sink, &fault);
    }
    if (!status) status = tell_blocks(sink, text.data);
    array_free(&sink->alloc, &text);
    return status;
}
