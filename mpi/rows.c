/* rows.c: see rows.h. A file is cut at the line ends behind equal shares of its bytes. Each rank counts the lines of
 * its share first, so that rows have their numbers in the whole file. A part becomes a file of its own, with the
 * header, which froe_read_own() reads. */
#include "rows.h"
#include "support/fail.h"
#include "support/path.h"
#include "support/text/csv.h"
#include <errno.h>
#include <froe/formats.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PART = 16 << 20 }; /* bytes of rows that are read at once */

typedef struct row_file {
    const char *path;
    FILE *file;
    char *header; /* with its line end, and none in front of it */
    size_t header_room;
    off_t begin, end; /* of this rank's rows */
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

/* How many rows begin there; blank lines are none. */
static froe_status count_rows(row_file *f, uint64_t *rows) {
    unsigned char block[1 << 16];
    bool blank = true; /* so far, in this line */
    *rows = 0;
    for (off_t left = f->end - f->begin; left > 0;) {
        const size_t most = left < (off_t)sizeof block ? (size_t)left : sizeof block;
        const size_t count = fread(block, 1, most, f->file);
        if (!count) return fail_file(f, "read");
        if (memchr(block, '"', count)) return fail_quoted(f);
        for (size_t at = 0; at < count;) {
            while (blank && at < count && block[at] <= ' ') at++;
            if (at == count) break;
            *rows += blank;
            const unsigned char *end = memchr(block + at, '\n', count - at);
            blank = end != NULL;
            at = end ? (size_t)(end - block) + 1 : count;
        }
        left -= (off_t)count;
    }
    return fseeko(f->file, f->begin, SEEK_SET) ? fail_file(f, "read") : FROE_OK;
}

/* Copies lines to a file of its own, until it is large enough. *at: where the next part begins. */
static froe_status copy_part(row_file *f, FILE *part, off_t *at, uint64_t *rows) {
    char *line = NULL;
    size_t room = 0;
    froe_status status = fputs(f->header, part) < 0 ? fail_file(f, "copied") : FROE_OK;
    const off_t begun = *at;
    for (*rows = 0; !status && *at < f->end && *at - begun < PART;) {
        const ssize_t count = getline(&line, &room, f->file);
        if (count <= 0 || fwrite(line, 1, (size_t)count, part) != (size_t)count)
            status = fail_file(f, "copied");
        else
            *rows += strspn(line, " \t\r\n") < (size_t)count, *at += count;
    }
    free(line);
    if (!status && fflush(part)) status = fail_file(f, "copied");
    return status;
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

/* The next part as a scene; none where all its lines are blank. */
static froe_status read_part(row_file *f, off_t *at, uint64_t first, froe_scene **out, uint64_t *rows) {
    char name[1024], told[512];
    const char *folder = getenv("TMPDIR");
    snprintf(name, sizeof name, "%.1000s/froe-mpi-XXXXXX", folder ? folder : "/tmp");
    const int handle = mkstemp(name);
    FILE *part = handle < 0 ? NULL : fdopen(handle, "wb");
    if (!part) return support_fail_file(f->diag, "made", name, errno);
    froe_read_options o = froe_read_defaults();
    snprintf(told, sizeof told, "%.400s: behind row %llu", support_short(f->path), (unsigned long long)first);
    o.name = told;
    froe_status status = copy_part(f, part, at, rows);
    fclose(part);
    if (!status && *rows) status = froe_read_own(name, &o, out, NULL, f->diag);
    unlink(name);
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

froe_status mpi_rows_dim(const char *path, int *dim, froe_diagnostic *diag) {
    row_file f = {.path = path, .diag = diag};
    froe_scene *scene = NULL;
    uint64_t rows = 0;
    bool tagged;
    froe_status status = open_rows(&f, 0, 1);
    if (!status) status = read_names(&f, &tagged);
    const off_t size = f.end;
    for (off_t at = f.begin; !status && !scene && at < size;) {
        f.end = at + 1; /* one line */
        status = read_part(&f, &at, 0, &scene, &rows);
    }
    if (!status && !scene) status = support_fail(diag, FROE_E_INPUT, "%s: There are no objects.", support_short(path));
    if (scene) *dim = froe_scene_dim(scene);
    froe_scene_free(scene);
    if (f.file) fclose(f.file);
    free(f.header);
    return status;
}

froe_status mpi_rows_read(const mpi_ranks *ranks, const char *path, mpi_rows_fn *fn, void *user,
                          froe_diagnostic *diag) {
    row_file f = {.path = path, .diag = diag};
    uint64_t rows = 0, first = 0;
    bool tagged = false;
    froe_status status = open_rows(&f, (uint64_t)ranks->rank, (uint64_t)ranks->count);
    if (!status) status = read_names(&f, &tagged);
    if (!status) status = count_rows(&f, &rows);
    MPI_Exscan(&rows, &first, 1, MPI_UINT64_T, MPI_SUM, ranks->comm);
    if (!ranks->rank) first = 0; /* which MPI leaves undefined */
    for (off_t at = f.begin; !status && at < f.end; first += rows) {
        froe_scene *scene = NULL;
        status = read_part(&f, &at, first, &scene, &rows);
        if (!status && scene && !fn(user, scene, first, tagged)) status = FROE_E_CANCELLED;
        froe_scene_free(scene);
    }
    if (f.file) fclose(f.file);
    free(f.header);
    return status;
}
