/* masked.c: files as assimp reads them, but for some bytes of the one that is imported. */
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

static struct aiFile *open_masked(struct aiFileIO *io, const char *path, const char *mode) {
    masked_import *m = (masked_import *)io->UserData;
    FILE *stream = *mode == 'r' ? fopen(path, "rb") : NULL;
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
