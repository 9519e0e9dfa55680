/* source.c: from a path to a scene, by the reader that is chosen by the first bytes of the file. */
#include "formats/input/source.h"
#include "support/decimal/decimal.h"
#include "support/locale.h"
#include "support/utf8.h"
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

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

double formats_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

size_t formats_drop_mark(char *text, size_t size) {
    static const char mark[] = {'\xef', '\xbb', '\xbf'};
    if (size < sizeof mark || memcmp(text, mark, sizeof mark) != 0) return size;
    memmove(text, text + sizeof mark, size - sizeof mark);
    return size - sizeof mark;
}

froe_status formats_source_open(const char *path, const froe_read_options *options, formats_source *source,
                                froe_diagnostic *diag) {
    const char *name = options && options->name ? options->name : path;
    *source = (formats_source){.file = path, .path = name, .options = options};
    struct stat about;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return support_fail_file(diag, "read", name, errno);
    ssize_t got = -1;
    int error = fstat(file, &about) ? errno : 0;
    bool regular = !error && S_ISREG(about.st_mode);
    if (regular) {
        got = read_fully(file, source->head, sizeof source->head - 1);
        if (got < 0) error = errno;
    }
    close(file);
    if (error) return support_fail_file(diag, "read", name, error);
    if (!regular) return support_fail_irregular(diag, name, about.st_mode);
    if (!got) return support_fail(diag, FROE_E_FORMAT, "%s: The file is empty.", support_short(name));
    source->head[formats_drop_mark(source->head, (size_t)got)] = '\0';
    source->size = (uint64_t)about.st_size;
    source->extension = support_path_extension(path);
    return FROE_OK;
}

bool formats_is_moving(const formats_source *source) {
    return !strcmp(source->extension.text, "mfjson") ||
           (strchr(source->head, '{') &&
            (strstr(source->head, "\"temporalGeometry\"") || strstr(source->head, "\"MovingLineString\"")));
}

bool formats_is_collection(const formats_source *source) {
    static const char *const words[] = {"{", "\"type\"", ":", "\"FeatureCollection\""};
    const char *at = source->head;
    if (strcmp(source->extension.text, "geojson") != 0 && strcmp(source->extension.text, "json") != 0) return false;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        at += strspn(at, " \t\r\n");
        if (strncmp(at, words[i], strlen(words[i])) != 0) return false;
        at += strlen(words[i]);
    }
    return true;
}

void formats_end_lines(char *text) {
    for (char *at = text; (at = strchr(at, '\r')); at++)
        if (at[1] != '\n') *at = '\n';
}

froe_status formats_load_part(const formats_source *source, formats_sink *sink, size_t start, size_t size,
                              formats_text *text) {
    enum { BEHIND = 1 + SUPPORT_DECIMAL_AHEAD };
    const bool room = size < SIZE_MAX - BEHIND && array_reserve(&sink->alloc, text, size + BEHIND);
    if (!room) return support_fail_memory(sink->diag);
    int file = open(source->file, O_RDONLY | O_CLOEXEC);
    const bool there = file >= 0 && (!start || lseek(file, (off_t)start, SEEK_SET) >= 0);
    ssize_t got = there ? read_fully(file, text->data, size) : -1;
    int error = errno;
    if (file >= 0) close(file);
    if (got < 0) return support_fail_file(sink->diag, "read", source->path, error);
    text->count = (size_t)got;
    memset(text->data + text->count, '\0', BEHIND);
    return FROE_OK;
}

froe_status formats_load(const formats_source *source, formats_sink *sink, bool binary, formats_text *text) {
    const froe_status status = formats_load_part(source, sink, 0, (size_t)source->size, text);
    if (status) return status;
    const size_t read = text->count;
    text->count = formats_drop_mark(text->data, read);
    memset(text->data + text->count, '\0', read - text->count);
    if (!binary && memchr(text->data, '\0', text->count)) return formats_refuse_zero(source, sink, strlen(text->data));
    if (!binary && !memchr(text->data, '\n', text->count)) formats_end_lines(text->data);
    return FROE_OK;
}

bool formats_is_utf16(const formats_source *source) {
    const size_t most = sizeof source->head - 1;
    return support_is_utf16(source->head, source->size < most ? (size_t)source->size : most);
}

froe_status formats_refuse_utf16(const formats_source *source, const formats_sink *sink) {
    return support_fail(sink->diag, FROE_E_FORMAT, "%s: %s", support_short(source->path), support_utf16_sentence);
}

froe_status formats_refuse_zero(const formats_source *source, const formats_sink *sink, size_t byte) {
    if (formats_is_utf16(source)) return formats_refuse_utf16(source, sink);
    return support_fail(sink->diag, FROE_E_FORMAT, "%s: The file is not text, because byte %zu is zero.",
                        support_short(source->path), byte);
}

void formats_report_format(formats_sink *sink, const char *precision, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(sink->report.format, sizeof sink->report.format, format, args);
    va_end(args);
    snprintf(sink->report.precision, sizeof sink->report.precision, "%s", precision);
}

/* Fills the sink and takes the scene from it. Only maps have layers and attributes: a filter of another file is
 * refused, rather than ignored. */
static froe_status fill_scene(const formats_readers *readers, const formats_source *source, formats_sink *sink,
                              froe_scene **out) {
    const char *name = support_short(source->path);
    const froe_read_options *o = source->options;
    if (!source->beyond && froe_is_tree(source->file))
        return support_fail(sink->diag, FROE_E_UNSUPPORTED, "%s: The file holds a tree, not a scene.", name);
    if (formats_is_moving(source))
        return support_fail(sink->diag, FROE_E_UNSUPPORTED,
                            "%s: The file holds moving features, which are no scene at rest.", name);
    formats_reader *reader = source->beyond ? readers->maps : readers->choose(source);
    if (!reader)
        return support_fail(sink->diag, FROE_E_UNSUPPORTED,
                            "%s: The file is neither CSV, OFF, OBJ or PLY nor a collection of features in GeoJSON.",
                            name);
    if (reader != readers->maps && (o->layer || o->where || o->wrap))
        return support_fail(sink->diag, FROE_E_OPTIONS, "%s: The file is not a map, and has no %s.", name,
                            o->layer   ? "layers"
                            : o->where ? "attributes to filter by"
                                       : "antimeridian to be cut at");
    froe_status status = reader(source, sink);
    if (!status) status = formats_sink_end_feature(sink);
    const char *left = sink->report.sorts_left;
    if (!status && !sink->total)
        status = support_fail(sink->diag, FROE_E_INPUT,
                              "%s: The file holds no objects (%llu feature%s without geometry, %llu skipped%s%s).",
                              name, (unsigned long long)sink->report.no_geometry,
                              support_plural(sink->report.no_geometry), (unsigned long long)sink->report.skipped,
                              *left ? ", and others of sorts that are not read: " : "", left);
    if (!status) status = formats_sink_progress(sink, 1);
    return status ? status : formats_sink_take(sink, out);
}

froe_status formats_check_reading(const char *name, const char *path, const froe_read_options *options,
                                  froe_scene **out, froe_diagnostic *diag) {
    if (!path || !out) return support_fail_null(diag, name);
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_read_defaults");
    if (options && options->faces != FROE_FACES_TRIANGLES && options->faces != FROE_FACES_POLYGONS)
        return support_fail(diag, FROE_E_OPTIONS, "There is no way of reading faces %d.", (int)options->faces);
    return FROE_OK;
}

froe_status formats_read(const formats_readers *readers, const char *path, const froe_read_options *options,
                         froe_scene **out, froe_read_report *report, froe_diagnostic *diag) {
    double start = formats_seconds();
    const froe_read_options defaults = froe_read_defaults(), *o = options ? options : &defaults;
    formats_sink sink = {.alloc = support_allocator(o->alloc),
                         .diag = diag,
                         .path = o->name ? o->name : path,
                         .faces = o->faces,
                         .boxes = o->boxes,
                         .halves = o->boxes && o->wrap,
                         .progress = o->progress,
                         .user = o->user,
                         .image = o->image,
                         .image_user = o->image_user,
                         .deliver = readers->deliver,
                         .deliver_user = readers->user};
    support_locale locale;
    if (!support_locale_enter(&locale)) return support_fail_memory(diag);
    formats_source source = {
        .file = path, .path = sink.path, .options = o, .beyond = readers->beyond && support_path_is_beyond(path)};
    source.extension = support_path_extension(path);
    froe_status status = source.beyond ? FROE_OK : formats_source_open(path, o, &source, diag);
    if (!status) status = fill_scene(readers, &source, &sink, out);
    formats_sink_free(&sink);
    support_locale_leave(&locale);
    sink.report.seconds = formats_seconds() - start;
    if (!status && report) *report = sink.report;
    return status;
}
