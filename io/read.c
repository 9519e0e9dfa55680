/* read.c: froe_read: recognises the format of a file and calls its reader. */
#include "read.h"
#include "support/floats.h"
#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

froe_read_options froe_read_defaults(void) {
    return (froe_read_options){.size = sizeof(froe_read_options), .faces = FROE_FACES_TRIANGLES};
}

void io_report_format(io_sink *sink, const char *precision, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(sink->report.format, sizeof sink->report.format, format, args);
    va_end(args);
    snprintf(sink->report.precision, sizeof sink->report.precision, "%s", precision);
}

/* Reads until the buffer is full or the file ends; -1 with errno on failure. */
static ssize_t read_fully(int file, char *to, size_t size) {
    size_t done = 0;
    while (done < size) {
        ssize_t got = read(file, to + done, size - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (!got) break;
        done += (size_t)got;
    }
    return (ssize_t)done;
}

froe_status io_load(const io_source *source, io_sink *sink, bool binary, io_buffer *text) {
    char *to = source->size < SIZE_MAX ? io_buffer_add(&sink->alloc, text, (size_t)source->size + 1) : NULL;
    if (!to) return io_fail(sink->diag, FROE_E_MEMORY, "%s: out of memory for the text", io_short(source->path));
    int file = open(source->path, O_RDONLY | O_CLOEXEC);
    ssize_t got = file < 0 ? -1 : read_fully(file, to, (size_t)source->size);
    int error = errno;
    if (file >= 0) close(file);
    if (got < 0) return io_fail_file(sink->diag, source->path, error);
    to[got] = '\0';
    text->size = (size_t)got;
    if (!binary && memchr(to, '\0', (size_t)got))
        return io_fail(sink->diag, FROE_E_FORMAT, "%s: is not text: byte %zu is zero", io_short(source->path),
                       strlen(to));
    return FROE_OK;
}

/* Opens the file just long enough to know its size and its first bytes. */
static froe_status look_at_file(io_source *source, froe_diagnostic *diag) {
    const char *name = io_short(source->path);
    struct stat about;
    int file = open(source->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return io_fail_file(diag, source->path, errno);
    ssize_t got = -1;
    int error = fstat(file, &about) ? errno : 0;
    bool regular = !error && S_ISREG(about.st_mode), directory = !error && S_ISDIR(about.st_mode);
    if (regular) {
        got = read_fully(file, source->head, sizeof source->head - 1);
        if (got < 0) error = errno;
    }
    close(file);
    if (error) return io_fail_file(diag, source->path, error);
    if (!regular)
        return io_fail(diag, FROE_E_IO, "%s: is %s, not a file", name, directory ? "a directory" : "a device");
    if (!got) return io_fail(diag, FROE_E_FORMAT, "%s: is empty", name);
    source->head_size = (size_t)got;
    source->head[got] = '\0';
    source->size = (uint64_t)about.st_size;
    source->extension = io_path_extension(source->path);
    return FROE_OK;
}

static bool has_extension(const io_source *source, const char *extension) {
    return !strcmp(source->extension.text, extension);
}

/* The first word is OFF, possibly with letters for what its vertices carry. */
static bool looks_like_off(const io_source *source) {
    const char *at = source->head;
    at += strspn(at, " \t\r\n");
    at += strspn(at, "STCN4n");
    return !strncmp(at, "OFF", 3) && (isspace((unsigned char)at[3]) || !at[3]);
}

static bool is_moving(const io_source *source) {
    return has_extension(source, "mfjson") ||
           (strchr(source->head, '{') &&
            (strstr(source->head, "\"temporalGeometry\"") || strstr(source->head, "\"MovingLineString\"")));
}

static io_reader *choose(const io_source *source) {
    if (io_csv_recognise(source)) return io_read_csv;
    if (looks_like_off(source)) return io_read_off;
    if (!strncmp(source->head, "ply\n", 4) || !strncmp(source->head, "ply\r", 4)) return io_read_ply;
    if (has_extension(source, "ply")) return io_read_ply;
    if (has_extension(source, "obj")) return io_read_obj;
    if (io_assimp_recognise(source)) return io_read_assimp;
    return io_read_ogr;
}

static froe_status check_read_options(const char *path, const froe_read_options *o, froe_scene **out,
                                      froe_diagnostic *diag) {
    if (!path || !out) return io_fail(diag, FROE_E_ARG, "froe_read: path and out must not be NULL");
    if (o && o->size != sizeof *o)
        return io_fail(diag, FROE_E_OPTIONS, "froe_read: the options do not come from froe_read_defaults()");
    if (o && o->faces != FROE_FACES_TRIANGLES && o->faces != FROE_FACES_POLYGONS)
        return io_fail(diag, FROE_E_OPTIONS, "froe_read: faces are triangles or polygons, not %d", (int)o->faces);
    return FROE_OK;
}

/* Only maps have layers and attributes: a filter of another file is refused, rather than ignored. */
static froe_status check_filters(const io_source *source, io_reader *reader, froe_diagnostic *diag) {
    const froe_read_options *o = source->options;
    if (reader == io_read_ogr || (!o->layer && !o->where)) return FROE_OK;
    return io_fail(diag, FROE_E_OPTIONS, "%s: is not a map: it has no %s", io_short(source->path),
                   o->layer ? "layers" : "attributes to filter by");
}

static froe_status pour(const io_source *source, io_sink *sink, froe_scene **out) {
    if (is_moving(source))
        return io_fail(sink->diag, FROE_E_UNSUPPORTED, "%s: holds moving features, which are no scene at rest",
                       io_short(source->path));
    io_reader *reader = choose(source);
    froe_status status = check_filters(source, reader, sink->diag);
    if (!status) status = reader(source, sink);
    if (!status) status = io_sink_end_feature(sink);
    if (!status && !sink->total)
        status =
            io_fail(sink->diag, FROE_E_INPUT, "%s: holds no objects (%llu features without geometry, %llu skipped)%s",
                    io_short(source->path), (unsigned long long)sink->report.no_geometry,
                    (unsigned long long)sink->report.skipped,
                    reader == io_read_ogr && has_extension(source, "csv")
                        ? "; a CSV begins with a line like x,y or x,y,r or lo_x,lo_y,hi_x,hi_y"
                        : "");
    if (!status) status = io_sink_progress(sink, 1);
    return status ? status : io_sink_take(sink, out);
}

froe_status froe_read(const char *path, const froe_read_options *options, froe_scene **out, froe_read_report *report,
                      froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    double start = io_seconds();
    froe_read_options defaults = froe_read_defaults();
    froe_status status = check_read_options(path, options, out, diag);
    if (status) return status;
    io_source source = {.path = path, .options = options ? options : &defaults};
    const froe_read_options *o = source.options;
    io_sink sink = {.alloc = io_allocator(o->alloc),
                    .diag = diag,
                    .path = path,
                    .faces = o->faces,
                    .boxes = o->boxes,
                    .progress = o->progress,
                    .user = o->user};
    io_locale locale;
    if (!io_locale_enter(&locale)) return io_fail_memory(diag);
    status = look_at_file(&source, diag);
    if (!status) status = pour(&source, &sink, out);
    io_sink_free(&sink);
    io_locale_leave(&locale);
    sink.report.seconds = io_seconds() - start;
    if (!status && report) *report = sink.report;
    return status;
}
