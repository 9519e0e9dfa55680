/* rows.c: see rows.h. A file is cut at the line ends behind equal shares of its bytes. Each rank counts the lines of
 * its share first, so that rows have their numbers in the whole file. A part becomes a file of its own, with the
 * header, which froe_read_batches() reads; its ending tells the reader what it is where the header is long. */
#define _DEFAULT_SOURCE 1 /* mkstemps */
#include "rows.h"
#include "support/fail.h"
#include "support/path.h"
#include "support/text/csv.h"
#include <errno.h>
#include <froe/formats.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PART = 2 << 20 }; /* bytes of rows that are read at once: those of all ranks are to stay in the cache */

typedef struct row_file {
    const char *path;
    FILE *file;
    char *header; /* with its line end, and none in front of it */
    size_t header_room;
    off_t begin, end; /* of this rank's rows */
    bool unwritten;   /* it is the copy of a part that failed */
    froe_diagnostic *diag;
} row_file;

static froe_status fail_file(row_file *f, const char *done) {
    return support_fail_file(f->diag, done, f->path, errno);
}

/* The first byte behind the line that the byte before `at` is in. */
static off_t next_line(row_file *f, off_t at, off_t least, off_t size) {
    if (at <= least) return least;
    if (fseeko(f->file, at - 1, SEEK_SET)) return -1;
    for (int c; (c = getc(f->file)) != EOF && c != '\n';) {
    }
    const off_t found = ftello(f->file);
    return found > size ? size : found;
}

/* Where part `part` of `parts` begins, if rows may be cut. */
static off_t cut(off_t header, off_t rest, uint64_t part, uint64_t parts) {
    const uint64_t bytes = (uint64_t)rest;
    return header + (off_t)(bytes / parts * part + bytes % parts * part / parts);
}

static froe_status open_rows(row_file *f, uint64_t part, uint64_t parts) {
    struct stat info;
    if (!stat(f->path, &info) && !S_ISREG(info.st_mode)) /* a pipe would be waited for */
        return support_fail_irregular(f->diag, f->path, info.st_mode);
    f->file = fopen(f->path, "rb");
    if (!f->file) return fail_file(f, "opened");
    const ssize_t header = getline(&f->header, &f->header_room, f->file);
    if (header <= 0) return support_fail(f->diag, FROE_E_FORMAT, "%s: The file is empty.", support_short(f->path));
    if (fseeko(f->file, 0, SEEK_END)) return fail_file(f, "read");
    const off_t size = ftello(f->file), rest = size - header;
    f->begin = next_line(f, cut(header, rest, part, parts), header, size);
    f->end = part + 1 == parts ? size : next_line(f, cut(header, rest, part + 1, parts), header, size);
    return f->begin < 0 || f->end < 0 || fseeko(f->file, f->begin, SEEK_SET) ? fail_file(f, "read") : FROE_OK;
}

static froe_status fail_quoted(const row_file *f) {
    return support_fail(f->diag, FROE_E_UNSUPPORTED, "%s: Rows with quotation marks are not read by several processes.",
                        support_short(f->path));
}

/* How many rows begin in a block; blank lines are none. *blank: so far, in the line that it ends in. */
static uint64_t count_rows(const unsigned char *block, size_t count, bool *blank) {
    uint64_t rows = 0;
    for (size_t at = 0; at < count;) {
        while (*blank && at < count && block[at] <= ' ') at++;
        if (at == count) break;
        rows += *blank;
        const unsigned char *end = memchr(block + at, '\n', count - at);
        *blank = end != NULL;
        at = end ? (size_t)(end - block) + 1 : count;
    }
    return rows;
}

/* A part as a file, for the reader. */
typedef struct part_file {
    char name[PATH_MAX + 32];
    FILE *file; /* NULL: there is none */
    uint64_t rows;
} part_file;

static froe_status fail_part(row_file *f, const part_file *part, const char *done) {
    f->unwritten = true;
    return support_fail_file(f->diag, done, part->name, errno);
}

/* Reads what lies between two places, counts its rows, and copies it to a part, if there is one. */
static froe_status pass_lines(row_file *f, off_t begin, off_t end, const part_file *to, uint64_t *rows) {
    unsigned char block[1 << 16];
    bool blank = true;
    *rows = 0;
    if (fseeko(f->file, begin, SEEK_SET)) return fail_file(f, "read");
    for (off_t left = end - begin; left > 0;) {
        const size_t most = left < (off_t)sizeof block ? (size_t)left : sizeof block;
        const size_t count = fread(block, 1, most, f->file);
        if (!count) return fail_file(f, "read");
        if (memchr(block, '"', count)) return fail_quoted(f);
        if (to && fwrite(block, 1, count, to->file) != count) return fail_part(f, to, "written");
        *rows += count_rows(block, count, &blank);
        left -= (off_t)count;
    }
    return FROE_OK;
}

/* Have the rows tags? Refuses a header whose rows cannot be cut anywhere: corners of a hull belong together, and a name
 * that is not closed goes on in the next line. */
static froe_status read_names(const row_file *f, bool *tagged) {
    char *const names = strdup(f->header), *at = names;
    if (!names) return support_fail_memory(f->diag);
    if (!strncmp(at, "\xEF\xBB\xBF", 3)) at += 3; /* a byte order mark */
    const char separator = support_csv_separator(at);
    support_csv_field field = {.last = false};
    bool hulls = false;
    *tagged = false;
    while (!field.last) {
        field = support_csv_next(&at, separator);
        *tagged = *tagged || support_equal_nocase(field.text, "tag");
        hulls = hulls || support_equal_nocase(field.text, "hull");
    }
    free(names);
    if (field.open) return fail_quoted(f);
    return hulls ? support_fail(f->diag, FROE_E_UNSUPPORTED,
                                "%s: Hulls of several rows are not read by several processes.", support_short(f->path))
                 : FROE_OK;
}

static froe_status begin_part(row_file *f, const char *folder, part_file *part) {
    static const char ending[] = ".csv";
    *part = (part_file){.file = NULL};
    snprintf(part->name, sizeof part->name, "%.*s/.froe-XXXXXX%s", PATH_MAX, folder, ending);
    const int handle = mkstemps(part->name, (int)strlen(ending));
    part->file = handle < 0 ? NULL : fdopen(handle, "wb");
    return part->file ? FROE_OK : fail_part(f, part, "made");
}

/* Copies lines between two places behind the header, and lets fn have their objects. */
static froe_status read_part(row_file *f, off_t begin, off_t end, const char *folder, froe_objects_fn *fn, void *user,
                             uint64_t first, uint64_t *rows) {
    part_file part;
    char told[512];
    froe_read_options o = froe_read_defaults();
    snprintf(told, sizeof told, "%.400s: behind row %llu", support_short(f->path), (unsigned long long)first);
    o.name = told;
    froe_status status = begin_part(f, folder, &part);
    if (status) return status;
    if (fputs(f->header, part.file) < 0) status = fail_part(f, &part, "written");
    if (!status) status = pass_lines(f, begin, end, &part, &part.rows);
    if (fclose(part.file) && !status) status = fail_part(f, &part, "written");
    if (!status && part.rows) status = froe_read_batches(part.name, &o, fn, user, NULL, f->diag);
    unlink(part.name);
    *rows = part.rows;
    return status;
}

uint64_t mpi_rows_parts(const mpi_ranks *ranks, const char *path, size_t bytes) {
    struct stat info;
    const uint64_t size = stat(path, &info) ? 0 : (uint64_t)info.st_size, step = (uint64_t)ranks->count * bytes;
    return (size / step + 1) * (uint64_t)ranks->count;
}

froe_status mpi_rows_text(const char *path, uint64_t part, uint64_t parts, char **text, size_t *count,
                          froe_diagnostic *diag) {
    row_file f = {.path = path, .diag = diag};
    froe_status status = open_rows(&f, part, parts);
    const size_t header = status ? 0 : strlen(f.header), rows = status ? 0 : (size_t)(f.end - f.begin);
    *count = header + rows;
    if (!status && !(*text = malloc(*count + 1))) status = support_fail_memory(diag);
    if (!status) {
        memcpy(*text, f.header, header);
        (*text)[*count] = '\0';
        if (fread(*text + header, 1, rows, f.file) != rows) status = fail_file(&f, "read");
        if (!status && memchr(*text + header, '"', rows)) status = fail_quoted(&f);
    }
    if (f.file) fclose(f.file);
    free(f.header);
    return status;
}

/* A froe_objects_fn that stops at once. */
static froe_status take_dim(void *user, int dim, const froe_objects *batch, froe_diagnostic *diag) {
    (void)batch, (void)diag;
    *(int *)user = dim;
    return FROE_OK;
}

static froe_status find_dim(const char *path, int *dim, bool *unwritten, froe_diagnostic *diag) {
    row_file f = {.path = path, .diag = diag};
    const char *folder = getenv("TMPDIR");
    bool tagged;
    *dim = 0;
    froe_status status = open_rows(&f, 0, 1);
    if (!status) status = read_names(&f, &tagged);
    for (off_t at = f.begin, end; !status && !*dim && at < f.end; at = end) { /* one line */
        uint64_t rows;
        end = next_line(&f, at + 1, at, f.end);
        status =
            end < 0 ? fail_file(&f, "read") : read_part(&f, at, end, folder ? folder : "/tmp", take_dim, dim, 0, &rows);
    }
    if (!status && !*dim) status = support_fail(diag, FROE_E_INPUT, "%s: There are no objects.", support_short(path));
    if (f.file) fclose(f.file);
    free(f.header);
    *unwritten = f.unwritten;
    return status;
}

froe_status mpi_rows_dim(const mpi_ranks *ranks, const char *path, int *dim, bool *unwritten, froe_diagnostic *diag) {
    *unwritten = false;
    const froe_status mine = ranks->rank ? FROE_OK : find_dim(path, dim, unwritten, diag);
    const froe_status status = mpi_agree(ranks, mine, diag);
    MPI_Bcast(dim, 1, MPI_INT, 0, ranks->comm);
    return status;
}

/* Who has the objects of a part. */
typedef struct receiver {
    mpi_rows_fn *fn;
    void *user;
    uint64_t first;
    bool tagged;
} receiver;

/* A froe_objects_fn. Without a column of tags the reader has numbered the objects of the part alone. */
static froe_status hand_over(void *user, int dim, const froe_objects *given, froe_diagnostic *diag) {
    (void)dim, (void)diag;
    receiver *r = user;
    froe_objects batch = *given;
    if (!r->tagged) batch.tags = NULL;
    const uint64_t first = r->first;
    r->first += batch.count;
    return r->fn(r->user, &batch, first) ? FROE_OK : FROE_E_CANCELLED;
}

froe_status mpi_rows_read(const mpi_ranks *ranks, const char *path, const char *folder, mpi_rows_fn *fn, void *user,
                          bool *unwritten, froe_diagnostic *diag) {
    row_file f = {.path = path, .diag = diag};
    receiver r = {.fn = fn, .user = user};
    uint64_t rows = 0, first = 0;
    froe_status status = open_rows(&f, (uint64_t)ranks->rank, (uint64_t)ranks->count);
    if (!status) status = read_names(&f, &r.tagged);
    if (!status) status = pass_lines(&f, f.begin, f.end, NULL, &rows);
    first = mpi_sum_before(ranks, rows);
    for (off_t at = f.begin, end; !status && at < f.end; at = end, first += rows) {
        r.first = first;
        end = f.end - at <= PART ? f.end : next_line(&f, at + PART, at, f.end);
        status = end < 0 ? fail_file(&f, "read") : read_part(&f, at, end, folder, hand_over, &r, first, &rows);
    }
    if (f.file) fclose(f.file);
    free(f.header);
    *unwritten = f.unwritten;
    return status;
}
