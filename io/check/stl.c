/* stl.c: is an STL file whole? assimp reads a text that was cut off as far as it goes. Of a binary file whose length is
 * another one than its header says, it tells only that the type is unknown.
 *
 *     80 bytes: anything   4 bytes: the number of triangles   50 bytes: a triangle   50 bytes: a triangle   ... */
#include "assimp_nodes.h"
#include <string.h>
#include <strings.h>

enum { HEADER = 84, TRIANGLE = 50 };

bool io_is_stl(const formats_source *source) {
    return !strcmp(source->extension.text, "stl");
}

/* Does the last line of the text begin with "endsolid"? A name of any length may follow it. */
static froe_status check_text(const formats_source *source, formats_sink *sink) {
    enum { LAST = 4096 };
    static const char word[] = "endsolid", blanks[] = " \t\r\n";
    const size_t size = (size_t)source->size, last = size < LAST ? size : LAST;
    formats_text text = {0};
    const froe_status status = formats_load_part(source, sink, size - last, last, &text);
    bool whole = false;
    for (const char *at = status ? NULL : text.data; at; at = strpbrk(at, "\r\n")) {
        at += strspn(at, blanks);
        if (*at) whole = !strncasecmp(at, word, strlen(word));
    }
    array_free(&sink->alloc, &text);
    if (status || whole) return status;
    return support_fail(sink->diag, FROE_E_FORMAT,
                        "%s: The text does not end with a line 'endsolid', so that triangles may be missing.",
                        support_short(source->path));
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
