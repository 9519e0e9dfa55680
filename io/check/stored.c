/* stored.c: whether files that are stored in a zip archive without compression have the checksums that the archive
 * keeps of them (APPNOTE of PKWARE, 4.3). GDAL and assimp compare those of compressed files alone, or none.
 *
 *     local header, name, bytes; local header, name, bytes; ...; directory: an entry for each; end of the directory
 *
 * Archives beyond 4 GB, and what is encrypted, are left to these libraries. */
#include "check/check.h"
#include <string.h>

enum { LOCAL = 30, ENTRY = 46, END = 22, COMMENT = 65535, CHUNK = 1 << 20 };

static size_t half_at(const char *at) {
    return (unsigned char)at[0] | (size_t)(unsigned char)at[1] << 8;
}

/* Four bits at a time (CRC-32 of ISO 3309, reflected). */
static uint32_t checksum(uint32_t sum, const char *bytes, size_t count) {
    uint32_t steps[16];
    for (uint32_t i = 0; i < 16; i++) {
        steps[i] = i;
        for (int bit = 0; bit < 4; bit++) steps[i] = steps[i] >> 1 ^ (steps[i] & 1 ? 0xedb88320 : 0);
    }
    for (size_t i = 0; i < count; i++) {
        sum ^= (unsigned char)bytes[i];
        sum = sum >> 4 ^ steps[sum & 15];
        sum = sum >> 4 ^ steps[sum & 15];
    }
    return sum;
}

static froe_status check_entry(const formats_source *source, formats_sink *sink, const char *entry,
                               formats_text *text) {
    const size_t from = io_word_at(entry + 42), name = half_at(entry + 28);
    size_t left = io_word_at(entry + 20);
    uint32_t sum = UINT32_MAX;
    if (half_at(entry + 10) || half_at(entry + 8) & 1 || left == UINT32_MAX) return FROE_OK; /* is it compressed? */
    froe_status status = formats_load_part(source, sink, from, LOCAL, text);
    if (status || text->count < LOCAL || memcmp(text->data, "PK\3\4", 4) != 0) return status;
    size_t at = from + LOCAL + half_at(text->data + 26) + half_at(text->data + 28);
    for (size_t size; left && !status; at += size, left -= size) {
        text->count = 0;
        size = left < CHUNK ? left : CHUNK;
        status = formats_load_part(source, sink, at, size, text);
        if (!status) sum = checksum(sum, text->data, text->count);
        if (!status) status = formats_sink_progress(sink, 0);
    }
    if (status || (sum ^ UINT32_MAX) == io_word_at(entry + 16)) return status;
    return support_fail(sink->diag, FROE_E_FORMAT, "%s: '%.*s' is damaged in the archive.", support_short(source->path),
                        (int)(name < 80 ? name : 80), entry + ENTRY);
}

froe_status io_stored_check(const formats_source *source, formats_sink *sink) {
    formats_text tail = {0}, directory = {0}, text = {0};
    const size_t size = (size_t)source->size, behind = size < END + COMMENT ? size : END + COMMENT;
    froe_status status = formats_load_part(source, sink, size - behind, behind, &tail);
    size_t at = tail.count < END ? 0 : tail.count - END + 1; /* the end of the directory, plus 1 */
    while (at && memcmp(tail.data + at - 1, "PK\5\6", 4) != 0) at--;
    if (!status && at)
        status = formats_load_part(source, sink, io_word_at(tail.data + at + 15), io_word_at(tail.data + at + 11),
                                   &directory);
    for (size_t entry = 0, length; entry + ENTRY <= directory.count && !status; entry += length) {
        const char *from = directory.data + entry;
        length = ENTRY + half_at(from + 28) + half_at(from + 30) + half_at(from + 32);
        if (memcmp(from, "PK\1\2", 4) != 0 || length > directory.count - entry) break;
        text.count = 0;
        status = check_entry(source, sink, from, &text);
    }
    array_free(&sink->alloc, &tail);
    array_free(&sink->alloc, &directory);
    array_free(&sink->alloc, &text);
    return status;
}
