/* format.h: shapes with attributes, and the files they are written to. */
#ifndef FROE_IO_FORMAT_H
#define FROE_IO_FORMAT_H

#include "writer.h"

/** One attribute: a whole number, a text, or nothing ("unknown"). */
typedef struct io_attribute {
    const char *name;
    const char *text; /**< NULL: a number */
    uint64_t number;
    bool missing;
} io_attribute;

typedef enum io_sort { IO_POINTS, IO_LINE, IO_POLYGON, IO_SURFACE } io_sort;

enum { IO_MOST_ATTRIBUTES = 12 };

/** What is written: geometry and attributes. Each shape of a file has the same attributes. */
typedef struct io_shape {
    io_sort sort;
    int dim;
    const double *coords; /**< dim doubles per corner */
    size_t corners;
    const size_t *starts; /**< surfaces: faces are corners starts[f] .. starts[f+1]-1 */
    size_t faces;
    io_attribute attributes[IO_MOST_ATTRIBUTES];
    int attribute_count;
} io_shape;

typedef struct io_format {
    const char *name;
    int least_dim, most_dim;
    void (*begin)(io_writer *writer, const io_shape *like); /**< `like` has the names of the attributes */
    void (*shape)(io_writer *writer, const io_shape *shape, bool first);
    void (*end)(io_writer *writer);
} io_format;

/** By extension; NULL: none is known. */
const io_format *io_format_of(const char *path);

#endif
