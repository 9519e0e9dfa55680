/* source.h: a file about to be read, and how a reader is chosen and run. */
#ifndef FROE_FORMATS_SOURCE_H
#define FROE_FORMATS_SOURCE_H

#include "formats/input/sink.h"
#include "support/path.h"

/** What is known of a file before a reader is chosen. */
typedef struct formats_source {
    const char *file; /**< the path */
    const char *path; /**< what messages call it */
    support_extension extension;
    bool beyond;         /**< no file: a folder, or a name of the reader of maps (/vsi...); size and head are empty */
    uint64_t size;       /**< bytes */
    char head[4096 + 1]; /**< the first bytes behind a byte order mark, and a NUL */
    const froe_read_options *options;
} formats_source;

/** Opens the file just long enough to know its size and its first bytes. FROE_E_IO; FROE_E_FORMAT: it is empty. */
froe_status formats_source_open(const char *path, const froe_read_options *options, formats_source *source,
                                froe_diagnostic *diag);
/** Is it of moving features, by its extension or its content? */
bool formats_is_moving(const formats_source *source);

/** Is it a collection of features in GeoJSON, by its extension and its first bytes? */
bool formats_is_collection(const formats_source *source);

/** A reader adds the objects of the file to the sink, which it opens with the right dimension, and sets
 * report.format and report.precision. */
typedef froe_status formats_reader(const formats_source *source, formats_sink *sink);

/** The readers to choose from. */
typedef struct formats_readers {
    formats_reader *(*choose)(const formats_source *source); /**< NULL: there is none for this file */
    formats_reader *maps;     /**< whose files have attributes and longitudes, and perhaps layers; may be NULL */
    bool beyond;              /**< maps may be no files: folders, and names in virtual file systems */
    froe_objects_fn *deliver; /**< where objects go; NULL: into a scene */
    void *user;
} formats_readers;

/** Does the public function `name` accept these arguments? FROE_E_ARG, FROE_E_OPTIONS. */
froe_status formats_check_reading(const char *name, const char *path, const froe_read_options *options,
                                  froe_scene **out, froe_diagnostic *diag);
/** As froe_read(), with these readers, and arguments that were accepted. */
froe_status formats_read(const formats_readers *readers, const char *path, const froe_read_options *options,
                         froe_scene **out, froe_read_report *report, froe_diagnostic *diag);

typedef ARRAY(char) formats_text;
/** The whole file but for a byte order mark, and behind it a NUL and as many more as numbers are read ahead
 * (support/decimal/decimal.h). Where lines of a text end by returns alone, these become line feeds. FROE_E_IO,
 * FROE_E_MEMORY; FROE_E_FORMAT when a text holds a NUL. */
froe_status formats_load(const formats_source *source, formats_sink *sink, bool binary, formats_text *text);

/** Takes the byte order mark of UTF-8 (RFC 3629, section 6) from the beginning of a text: it is no part of it, and a
 * word behind it would not be recognised. No binary format begins with these bytes. Returns how many bytes are left. */
size_t formats_drop_mark(char *text, size_t size);

/** Returns that end lines by themselves, as on an old Macintosh, become line feeds: for formats in which no text has
 * returns. */
void formats_end_lines(char *text);
/** `size` bytes of the file from a byte on, or fewer where it ends before, and the same zeros behind them. FROE_E_IO,
 * FROE_E_MEMORY. */
froe_status formats_load_part(const formats_source *source, formats_sink *sink, size_t start, size_t size,
                              formats_text *text);

/** Does the file seem to be text in UTF-16, which only some of the libraries read? */
bool formats_is_utf16(const formats_source *source);
/** FROE_E_FORMAT for such a file, which no reader takes. */
froe_status formats_refuse_utf16(const formats_source *source, const formats_sink *sink);

/** FROE_E_FORMAT for a text with a NUL at some byte. */
froe_status formats_refuse_zero(const formats_source *source, const formats_sink *sink, size_t byte);
/** The same text, but mapped, so that it takes memory only where it is read, and a NUL may stand in it: `capacity` is
 * the size of the mapping. What has been read is given back by formats_pass_text(): everything before a place.
 * FROE_E_FORMAT also for lines that end by returns alone. */
froe_status formats_map_text(const formats_source *source, const formats_sink *sink, formats_text *text);
void formats_pass_text(formats_text *text, const char *at);
void formats_unmap_text(formats_text *text);

/** Seconds of a clock that only goes forward. */
double formats_seconds(void);

void formats_report_format(formats_sink *sink, const char *precision, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
