/* stl.c: is an STL file whole? assimp reads a text that was cut off as far as it goes, and of a facet the first three
 * vertices. Of a binary file whose length is another one than its header says, it tells only that the type is unknown.
 *
 *     80 bytes: anything   4 bytes: the number of triangles   50 bytes: a triangle   50 bytes: a triangle   ... */
#include "check/check.h"
#include <string.h>
#include <strings.h>

enum { HEADER = 84, TRIANGLE = 50 };

bool io_is_stl(const formats_source *source) {
    return !strcmp(source->extension.text, "stl");
}

static const char blanks[] = " \t\r\n";

static bool is_word(const char *at, size_t length, const char *word) {
    return length == strlen(word) && !strncasecmp(at, word, length);
}

/* The line, from 1, of the first vertex behind the third of a facet, which assimp leaves out; 0: there is none. */
static size_t find_fourth(const char *text) {
    size_t line = 1, vertices = 0, length;
    bool inside = false; /* a facet: names of solids may be any words */
    for (const char *at = text; *at; at += length) {
        for (; *at && strchr(blanks, *at); at++) line += *at == '\n';
        length = strcspn(at, blanks);
        if (is_word(at, length, "facet")) inside = true, vertices = 0;
        if (is_word(at, length, "endfacet")) inside = false;
        if (inside && is_word(at, length, "vertex") && ++vertices > 3) return line;
    }
    return 0;
}

/* Does the last line of the text begin with "endsolid"? A name may follow it. */
static bool is_whole(const char *text) {
    static const char word[] = "endsolid";
    bool whole = false;
    for (const char *at = text; at; at = strpbrk(at, "\r\n")) {
        at += strspn(at, blanks);
        if (*at) whole = !strncasecmp(at, word, strlen(word));
    }
    return whole;
}

static froe_status check_text(const formats_source *source, formats_sink *sink) {
    const char *name = support_short(source->path);
    formats_text text = {0};
    froe_status status = formats_load_part(source, sink, 0, (size_t)source->size, &text);
    const size_t line = status ? 0 : find_fourth(text.data);
    if (line)
        status =
            support_fail(sink->diag, FROE_E_FORMAT, "%s: line %zu: The facet has more than 3 vertices.", name, line);
    if (!status && !is_whole(text.data))
        status =
            support_fail(sink->diag, FROE_E_FORMAT,
                         "%s: The text does not end with a line 'endsolid', so that triangles may be missing.", name);
    array_free(&sink->alloc, &text);
    return status;
}

froe_status io_stl_check(const formats_source *source, formats_sink *sink) {
    const char *name = support_short(source->path), *from = source->head + strspn(source->head, " \t\r\n");
    const size_t there = source->size < HEADER ? (size_t)source->size : HEADER;
    const uint64_t triangles = there < HEADER ? 0 : io_glb_number(source->head + HEADER - 4);
    const uint64_t size = HEADER + TRIANGLE * triangles;
    const bool text = !memchr(source->head, '\0', there);
    if (there == HEADER && source->size == size) return FROE_OK;
    if (text) return strncmp(from, "solid", 5) ? FROE_OK : check_text(source, sink);
    if (there < HEADER)
        return support_fail(sink->diag, FROE_E_FORMAT, "%s: A binary STL file has %d bytes at least, and this one %zu.",
                            name, HEADER, there);
    return support_fail(sink->diag, FROE_E_FORMAT,
                        "%s: This binary STL file has %llu bytes. For the %llu triangle%s of its header it needs %llu.",
                        name, (unsigned long long)source->size, (unsigned long long)triangles,
                        support_plural(triangles), (unsigned long long)size);
}
