/* writer.c: atomic text files, numbers and quotes. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "writer.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static froe_status fail(io_writer *w, int error) {
    return io_fail(w->diag, FROE_E_IO, "%s: cannot be written: %s", io_short(w->path), io_errno(error).text);
}

static const char *target_of(const io_writer *w) {
    return w->real ? w->real : w->path;
}

/* A file that did not exist before, beside the target. -1 with errno. */
static int create_beside(io_writer *w) {
    enum { ATTEMPTS = 100 };
    size_t room = strlen(target_of(w)) + 48;
    char *name = io_buffer_add(&w->alloc, &w->temporary, room);
    if (!name) return errno = ENOMEM, -1;
    int file = -1;
    for (int i = 0; i < ATTEMPTS && file < 0; ++i) {
        snprintf(name, room, "%s.%ld-%p-%d.tmp", target_of(w), (long)getpid(), (void *)w, i);
        file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0 && errno != EEXIST) return -1;
    }
    return file;
}

static int open_target(io_writer *w) {
    struct stat about;
    bool exists = !stat(w->path, &about);
    if (exists && S_ISDIR(about.st_mode)) return errno = EISDIR, -1;
    if (exists && !S_ISREG(about.st_mode)) return open(w->path, O_WRONLY | O_CLOEXEC);
    if (exists && !(w->real = realpath(w->path, NULL))) return -1;
    int file = create_beside(w);
    if (file >= 0 && exists && fchmod(file, about.st_mode & 07777)) errno = 0; /* a courtesy; may fail */
    return file;
}

static const char *temporary_name(const io_writer *w) {
    return w->temporary.size ? w->temporary.data : NULL;
}

static void forget(io_writer *w) {
    io_buffer_free(&w->alloc, &w->temporary);
    io_locale_leave(&w->locale);
    free(w->real);
}

froe_status io_writer_open(io_writer *w, const char *path, froe_diagnostic *diag) {
    *w = (io_writer){.path = path, .alloc = io_allocator(NULL), .diag = diag};
    if (!io_locale_enter(&w->locale)) return io_fail_memory(diag);
    int file = open_target(w), error = errno;
    if (file >= 0) w->file = fdopen(file, "w");
    if (w->file) return FROE_OK;
    if (file >= 0) {
        error = errno;
        close(file);
        if (temporary_name(w)) unlink(temporary_name(w));
    }
    forget(w);
    return error == ENOMEM ? io_fail_memory(diag) : fail(w, error);
}

froe_status io_writer_close(io_writer *w, froe_status status) {
    const char *temporary = temporary_name(w);
    int error = 0;
    errno = 0;
    if (fflush(w->file) || ferror(w->file)) error = errno ? errno : EIO;
    if (!error && temporary && !status && fsync(fileno(w->file))) error = errno;
    if (fclose(w->file) && !error) error = errno;
    if (!status && error) status = fail(w, error);
    if (temporary && !status && rename(temporary, target_of(w))) status = fail(w, errno);
    if (temporary && status) unlink(temporary);
    forget(w);
    return status;
}

/* ------------------------------------------------------------------ text -- */

void io_put(io_writer *w, const char *text) {
    fputs(text, w->file);
}

void io_put_number(io_writer *w, double value) {
    char text[40];
    if (fabs(value) < 1e15 && value == (double)(int64_t)value) {
        snprintf(text, sizeof text, "%lld", (long long)value);
    } else {
        snprintf(text, sizeof text, "%.15g", value); /* 0.1 stays 0.1; what has more digits gets all 17 */
        if (strtod(text, NULL) != value) snprintf(text, sizeof text, "%.17g", value);
    }
    io_put(w, text);
}

void io_put_whole(io_writer *w, uint64_t value) {
    fprintf(w->file, "%llu", (unsigned long long)value);
}

void io_put_point(io_writer *w, const double *p, int dim, const char *separator) {
    for (int k = 0; k < dim; ++k) {
        if (k) io_put(w, separator);
        io_put_number(w, p[k]);
    }
}

/* Bytes of the UTF-8 character at `c`; 0 when it is none (Unicode 15, table 3-7). */
static size_t utf8_length(const unsigned char *c) {
    if (c[0] < 0x80) return 1;
    size_t length = c[0] >= 0xc2 && c[0] <= 0xdf ? 2 : (c[0] & 0xf0) == 0xe0 ? 3 : c[0] >= 0xf0 && c[0] <= 0xf4 ? 4 : 0;
    for (size_t i = 1; i < length; ++i)
        if ((c[i] & 0xc0) != 0x80) return 0;
    bool overlong = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xf0 && c[1] < 0x90);
    bool beyond = (c[0] == 0xed && c[1] > 0x9f) || (c[0] == 0xf4 && c[1] > 0x8f);
    return overlong || beyond ? 0 : length;
}

void io_put_json(io_writer *w, const char *text) {
    const unsigned char *c = (const unsigned char *)text;
    fputc('"', w->file);
    while (*c) {
        size_t length = utf8_length(c);
        if (!length) {
            io_put(w, "\\ufffd");
        } else if (*c < 0x20 || *c == 0x7f) {
            fprintf(w->file, "\\u%04x", *c);
        } else {
            if (*c == '"' || *c == '\\') fputc('\\', w->file);
            fwrite(c, 1, length, w->file);
        }
        c += length ? length : 1;
    }
    fputc('"', w->file);
}

void io_put_csv(io_writer *w, const char *text) {
    if (!strpbrk(text, ",\"\r\n")) return io_put(w, text);
    fputc('"', w->file);
    for (; *text; ++text) {
        if (*text == '"') fputc('"', w->file);
        fputc(*text, w->file);
    }
    fputc('"', w->file);
}

void io_put_word(io_writer *w, const char *text) {
    for (; *text; ++text) fputc((unsigned char)*text <= ' ' || *text == 0x7f ? '_' : *text, w->file);
}
