/* stl.c: whether an STL file is whole, and nothing of it would be passed over. assimp reads a text that was cut off as
 * far as it goes, of a facet the first three vertices, and nothing of solids behind other lines or in capital letters.
 * Of a binary file whose length is another one than its header says, it tells only that the type is unknown.
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

/* Does a line begin so? */
static bool begins(const char *at, const char *word) {
    return !strncasecmp(at, word, strlen(word));
}

/* What assimp would pass over in silence, and the line where it is, or 0 for the end of the text. NULL: nothing. Names
 * of solids may be any words. Behind the last solid anything may stand but a solid or a facet. */
static const char *find_fault(const char *text, size_t *line) {
    size_t number = 1, vertices = 0, length, stray = 0;
    bool inside = false, facet = false, whole = false; /* in a solid, in a facet; all solids have ended */
    for (const char *at = text; *at; at += length) {
        bool first = at == text; /* word of its line */
        for (; *at && strchr(blanks, *at); at++) {
            first = first || *at == '\n' || *at == '\r';
            number += *at == '\n';
        }
        length = strcspn(at, blanks);
        const bool facets = is_word(at, length, "facet"), solid = first && begins(at, "solid");
        *line = number;
        if ((solid || (first && facets)) && *at < 'a') return "Words such as 'facet' are not read in capital letters.";
        if (first && begins(at, "endsolid")) {
            whole = true;
            if (*at == 'e') inside = false, stray = 0; /* assimp does not know ENDSOLID */
        } else if (solid || (first && facets)) {
            if (!inside && stray) *line = stray;
            if (!inside && (stray || facets)) return "This is in no solid, and triangles behind it are not read.";
            whole = false, inside = true;
        } else if (first && length && !inside && !stray) {
            stray = number;
        }
        if (facets) facet = true, vertices = 0;
        if (is_word(at, length, "endfacet")) {
            if (inside && first && !facet) return "A facet ends here that has not begun.";
            if (facet && vertices < 3) return "The facet has less than 3 vertices.";
            facet = false;
        }
        if (facet && is_word(at, length, "vertex") && ++vertices > 3) return "The facet has more than 3 vertices.";
    }
    *line = 0;
    return whole ? NULL : "The text does not end with a line 'endsolid', so that triangles may be missing.";
}

static froe_status check_text(const formats_source *source, formats_sink *sink) {
    const char *name = support_short(source->path);
    formats_text text = {0};
    froe_status status = formats_load(source, sink, true, &text);
    size_t line = 0;
    const char *sentence = status ? NULL : find_fault(text.data, &line);
    if (sentence && line) status = support_fail(sink->diag, FROE_E_FORMAT, "%s: line %zu: %s", name, line, sentence);
    if (sentence && !line) status = support_fail(sink->diag, FROE_E_FORMAT, "%s: %s", name, sentence);
    array_free(&sink->alloc, &text);
    return status;
}

froe_status io_stl_check(const formats_source *source, formats_sink *sink, size_t *whole) {
    const char *name = support_short(source->path), *from = source->head + strspn(source->head, " \t\r\n");
    const size_t there = source->size < HEADER ? (size_t)source->size : HEADER;
    const uint64_t triangles = there < HEADER ? 0 : io_word_at(source->head + HEADER - 4);
    const uint64_t size = HEADER + TRIANGLE * triangles;
    const bool text = !memchr(source->head, '\0', there);
    if (there == HEADER && source->size == size) return FROE_OK;
    if (there == HEADER && triangles && size <= UINT32_MAX && source->size > size && source->size < size + TRIANGLE)
        return *whole = (size_t)size, FROE_OK;
    if (text) return begins(from, "solid") ? check_text(source, sink) : FROE_OK;
    if (there < HEADER)
        return support_fail(sink->diag, FROE_E_FORMAT, "%s: A binary STL file has %d bytes at least, and this one %zu.",
                            name, HEADER, there);
    return support_fail(sink->diag, FROE_E_FORMAT,
                        "%s: This binary STL file has %llu bytes. For the %llu triangle%s of its header it needs %llu.",
                        name, (unsigned long long)source->size, (unsigned long long)triangles,
                        support_plural(triangles), (unsigned long long)size);
}
