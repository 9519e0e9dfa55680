/* mapped.c: a text of any length in little memory: its file is mapped, may be changed in place, which no file sees, and
 * is given back as it is read.
 *
 *     | passed ... | read now | not read yet ... | zeros |        pages of the file, and behind them one of zeros */
#define _GNU_SOURCE 1 /* madvise, MAP_ANONYMOUS */
#include "formats/input/source.h"
#include "support/decimal/decimal.h"
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* Returns that end lines by themselves are not changed, which would take memory for all of the text. */
static froe_status refuse_returns(const formats_source *source, const formats_sink *sink, const formats_text *text) {
    if (strchr(source->head, '\n') || !strchr(source->head, '\r') || memchr(text->data, '\n', text->count))
        return FROE_OK;
    return support_fail(sink->diag, FROE_E_FORMAT,
                        "%s: Its lines end by returns alone, and it must be saved with line feeds.",
                        support_short(source->path));
}

froe_status formats_map_text(const formats_source *source, const formats_sink *sink, formats_text *text) {
    static const char mark[] = "\xef\xbb\xbf";
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), size = (size_t)source->size;
    if (source->size >= SIZE_MAX / 2) return support_fail_memory(sink->diag);
    const size_t room = (size / page + 2) * page;
    const int file = open(source->file, O_RDONLY | O_CLOEXEC);
    if (file < 0) return support_fail_file(sink->diag, "read", source->path, errno);
    char *map = mmap(NULL, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    const bool all = map != MAP_FAILED;
    const bool over =
        all && size &&
        mmap(map, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_FIXED | MAP_NORESERVE, file, 0) == MAP_FAILED;
    const int error = errno;
    close(file);
    if (over) munmap(map, room);
    if (!all || over) return support_fail_file(sink->diag, "read", source->path, error);
    text->data = map;
    text->count = size;
    text->capacity = room;
    (void)madvise(map, size, MADV_SEQUENTIAL);
    if (size >= 3 && !memcmp(map, mark, 3)) memset(map, ' ', 3); /* a byte order mark, which is no part of the text */
    return refuse_returns(source, sink, text);
}

void formats_pass_text(formats_text *text, const char *at) {
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), passed = (size_t)(at - text->data) / page * page;
    /* Pages that were given back hold the file again when they are read again, which they are not. */
    const size_t window = (size_t)4 << 20, first = passed > window ? passed - window : 0;
    if (passed) (void)madvise(text->data + first / page * page, passed - first / page * page, MADV_DONTNEED);
}

void formats_unmap_text(formats_text *text) {
    if (text->data) munmap(text->data, text->capacity);
    text->data = NULL;
}
