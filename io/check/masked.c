/* masked.c: files as assimp reads them, but for some bytes of the one that is imported, and for the names of others in
 * it, which may be escaped: %20 is a blank (RFC 3986, 2.1). */
#include "check/check.h"
#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <stdio.h>
#include <string.h>

typedef struct masked_import {
    const char *path;
    const io_mask *mask;
    const froe_allocator *alloc;
    bool memory; /* there was always enough */
} masked_import;

typedef struct masked_file {
    struct aiFile file; /* its UserData is this */
    FILE *stream;
    const io_mask *mask; /* NULL: nothing is masked */
} masked_file;

static size_t read_masked(struct aiFile *file, char *bytes, size_t size, size_t count) {
    const masked_file *f = (const masked_file *)file->UserData;
    const long from = ftell(f->stream);
    const size_t got = fread(bytes, size, count, f->stream);
    for (size_t i = 0; f->mask && from >= 0 && i < f->mask->count; i++) {
        const size_t place = f->mask->data[i], first = (size_t)from;
        if (place >= first && place - first < got * size) bytes[place - first] = '_';
    }
    return got;
}

static size_t write_nothing(struct aiFile *file, const char *bytes, size_t size, size_t count) {
    (void)file, (void)bytes, (void)size, (void)count;
    return 0;
}

static size_t tell_place(struct aiFile *file) {
    const long at = ftell(((const masked_file *)file->UserData)->stream);
    return at < 0 ? 0 : (size_t)at;
}

static enum aiReturn seek_place(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    const int whence = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
    const int failed = fseek(((const masked_file *)file->UserData)->stream, (long)offset, whence);
    return failed ? aiReturn_FAILURE : aiReturn_SUCCESS;
}

static size_t tell_size(struct aiFile *file) {
    const size_t at = tell_place(file);
    (void)seek_place(file, 0, aiOrigin_END);
    const size_t size = tell_place(file);
    (void)seek_place(file, at, aiOrigin_SET);
    return size;
}

static void flush_nothing(struct aiFile *file) {
    (void)file;
}

static void close_masked(struct aiFileIO *io, struct aiFile *file) {
    masked_file *f = (masked_file *)file->UserData;
    fclose(f->stream);
    support_free(((const masked_import *)io->UserData)->alloc, f, sizeof *f);
}

static int hex_digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

void io_unescape(const char *name, char *out) {
    for (; *name; name++) {
        const int high = *name == '%' ? hex_digit(name[1]) : -1, low = high >= 0 ? hex_digit(name[2]) : -1;
        const int byte = low >= 0 ? 16 * high + low : 0;
        *out++ = byte ? (char)byte : *name;
        if (byte) name += 2;
    }
    *out = '\0';
}

/* Opens a file that the imported one names, in its folder or below. Some programs write names as they are. */
static FILE *open_named(masked_import *m, const char *path) {
    const size_t size = strlen(path) + 1;
    size_t folder = 0;                             /* what both names begin with */
    for (size_t i = 0; path[i] == m->path[i]; i++) /* they are not the same */
        if (path[i] == '/') folder = i + 1;
    char *plain = support_calloc(m->alloc, 1, size);
    if (!plain) return m->memory = false, NULL;
    memcpy(plain, path, folder);
    io_unescape(path + folder, plain + folder);
    FILE *stream = fopen(plain, "rb");
    support_free(m->alloc, plain, size);
    return stream ? stream : fopen(path, "rb");
}

static struct aiFile *open_masked(struct aiFileIO *io, const char *path, const char *mode) {
    masked_import *m = (masked_import *)io->UserData;
    FILE *stream = *mode != 'r' ? NULL : strcmp(path, m->path) ? open_named(m, path) : fopen(path, "rb");
    if (!stream) return NULL;
    masked_file *f = support_calloc(m->alloc, 1, sizeof *f);
    if (!f) return m->memory = false, fclose(stream), NULL;
    f->file = (struct aiFile){read_masked, write_nothing, tell_place, tell_size, seek_place, flush_nothing, (char *)f};
    f->stream = stream;
    f->mask = strcmp(path, m->path) ? NULL : m->mask;
    return &f->file;
}

const struct aiScene *io_import_masked(const char *path, const io_mask *mask, const froe_allocator *alloc,
                                       bool *memory) {
    masked_import m = {path, mask, alloc, true};
    struct aiFileIO io = {open_masked, close_masked, (char *)&m};
    const struct aiScene *scene = aiImportFileEx(path, 0, &io);
    *memory = m.memory;
    return scene;
}
