/* read.h: a file about to be read, and the readers. */
#ifndef FROE_IO_READ_H
#define FROE_IO_READ_H

#include "sink.h"

/** What is known of a file before a reader is chosen. */
typedef struct io_source {
    const char *path;
    io_extension extension;
    uint64_t size; /**< bytes */
    char head[4096 + 1];
    size_t head_size; /**< bytes of the file's beginning in `head`, which ends with a NUL */
    const froe_read_options *options;
} io_source;

/** A reader adds the objects of the file to the sink, which it opens with the right dimension, and sets
 * report.format and report.precision. */
typedef froe_status io_reader(const io_source *source, io_sink *sink);
io_reader io_read_csv, io_read_off, io_read_obj, io_read_ply, io_read_assimp, io_read_ogr;

/** Does the header line say points, boxes or balls? */
bool io_csv_recognise(const io_source *source);
/** Does the header line name a column of well-known text? */
bool io_csv_has_geometry(const io_source *source);
/** Does assimp read files with this extension? */
bool io_assimp_recognise(const io_source *source);

/** The whole file and a NUL behind it. FROE_E_IO, FROE_E_MEMORY; FROE_E_FORMAT when a text holds a NUL. */
froe_status io_load(const io_source *source, io_sink *sink, bool binary, io_buffer *text);

void io_report_format(io_sink *sink, const char *precision, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
