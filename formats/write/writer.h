/* writer.h: text, numbers and quotes into a file that appears whole or not at all. Errors are kept until
 * formats_writer_close(). */
#ifndef FROE_FORMATS_WRITER_H
#define FROE_FORMATS_WRITER_H

#include "support/fail.h"
#include "support/locale.h"
#include "support/path.h"
#include "support/writer.h"
#include <froe/formats.h>

typedef struct formats_writer {
    support_writer out;
    support_locale locale; /**< numbers have decimal points */
} formats_writer;

/** FROE_E_IO, FROE_E_MEMORY; on success formats_writer_close() must follow. */
froe_status formats_writer_open(formats_writer *writer, const char *path, froe_diagnostic *diag);
/** With FROE_OK: brings the file to its place. Otherwise removes it. Returns `status`, or FROE_E_IO
 * when something could not be written. */
froe_status formats_writer_close(formats_writer *writer, froe_status status);

void formats_put(formats_writer *writer, const char *text);
/** 15 digits when they give the same double again, or else 17, which always do. */
void formats_put_number(formats_writer *writer, double value);
void formats_put_whole(formats_writer *writer, uint64_t value);
/** dim numbers with blanks between them. */
void formats_put_point(formats_writer *writer, const double *p, int dim, const char *separator);
/** A string with its quotes. Bytes that are no UTF-8 become U+FFFD. */
void formats_put_json(formats_writer *writer, const char *text);
/** A field, quoted when it must be. */
void formats_put_csv(formats_writer *writer, const char *text);
/** A word: blanks and control characters become underscores. */
void formats_put_word(formats_writer *writer, const char *text);

#endif
