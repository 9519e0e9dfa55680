/* writer.h: text, numbers and quotes into a file that appears whole or not at all. Errors are kept until
 * io_writer_close(). */
#ifndef FROE_IO_WRITER_H
#define FROE_IO_WRITER_H

#include "common.h"
#include "support/writer.h"

typedef struct io_writer {
    support_writer out;
    io_locale locale; /**< numbers have decimal points */
} io_writer;

/** FROE_E_IO, FROE_E_MEMORY; on success io_writer_close() must follow. */
froe_status io_writer_open(io_writer *writer, const char *path, froe_diagnostic *diag);
/** With FROE_OK: brings the file to its place. Otherwise removes it. Returns `status`, or FROE_E_IO
 * when something could not be written. */
froe_status io_writer_close(io_writer *writer, froe_status status);

void io_put(io_writer *writer, const char *text);
/** 15 digits when they give the same double again, or else 17, which always do. */
void io_put_number(io_writer *writer, double value);
void io_put_whole(io_writer *writer, uint64_t value);
/** dim numbers with blanks between them. */
void io_put_point(io_writer *writer, const double *p, int dim, const char *separator);
/** A string with its quotes. Bytes that are no UTF-8 become U+FFFD. */
void io_put_json(io_writer *writer, const char *text);
/** A field, quoted when it must be. */
void io_put_csv(io_writer *writer, const char *text);
/** A word: blanks and control characters become underscores. */
void io_put_word(io_writer *writer, const char *text);

#endif
