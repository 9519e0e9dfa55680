/* lwo.c: whether a LightWave object (LWO2, version 6 and later) has what assimp would pass over. Of several lists of
 * polygons in a layer it reads the last one alone, and of an index that is the number of points it reads any memory.
 * Chunks are a name, a length with the highest byte first, and as many bytes, filled up to an even number:
 *
 *     FORM length LWO2   TAGS ...   LAYR ...   PNTS x y z x y z ...   POLS FACE 3 0 1 2  4 0 1 2 3 ...   LAYR ... */
#include "check/check.h"
#include <string.h>

enum { FORM = 12, CHUNK = 8, POINT = 12 };

bool io_is_lwo(const formats_source *source) {
    return !strncmp(source->head, "FORM", 4) && !strncmp(source->head + 8, "LWO2", 4);
}

static size_t big_endian(const unsigned char *at, size_t bytes) {
    size_t value = 0;
    for (size_t i = 0; i < bytes; i++) value = value << 8 | at[i];
    return value;
}

/* Does each polygon of a list name points that are there? An index has 2 bytes, or 4, of which the first is 255. */
static bool are_there(const unsigned char *at, const unsigned char *end, size_t points) {
    while (end - at >= 2) {
        size_t corners = big_endian(at, 2) & 0x3ff;
        for (at += 2; corners && end - at >= 2; corners--) {
            const bool wide = *at == 255 && end - at >= 4;
            if ((wide ? big_endian(at + 1, 3) : big_endian(at, 2)) >= points) return false;
            at += wide ? 4 : 2;
        }
        if (corners) return false;
    }
    return true;
}

froe_status io_lwo_check(const formats_source *source, formats_sink *sink) {
    formats_text text = {0};
    const froe_status status = formats_load_part(source, sink, 0, (size_t)source->size, &text);
    const unsigned char *bytes = (const unsigned char *)text.data;
    size_t layer = 0, points = 0, lists = 0, length;
    const char *sentence = NULL;
    for (size_t at = FORM; at + CHUNK <= text.count && !status && !sentence; at += CHUNK + length + length % 2) {
        const unsigned char *from = bytes + at + CHUNK;
        length = big_endian(bytes + at + 4, 4);
        if (length > text.count - at - CHUNK) break; /* assimp tells of that */
        if (!memcmp(bytes + at, "LAYR", 4)) layer++, points = lists = 0;
        if (!memcmp(bytes + at, "PNTS", 4)) points += length / POINT;
        if (memcmp(bytes + at, "POLS", 4) != 0 || length < 4) continue;
        if (lists++) sentence = "It has several lists of polygons (POLS), of which one alone would be read.";
        if (!are_there(from + 4, from + length, points)) sentence = "A polygon names a point that does not exist.";
    }
    array_free(&sink->alloc, &text);
    if (!sentence) return status;
    return support_fail(sink->diag, FROE_E_FORMAT, "%s: layer %zu: %s", support_short(source->path), layer, sentence);
}
