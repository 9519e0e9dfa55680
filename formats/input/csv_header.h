/* csv_header.h: the header line of comma-separated values: is it one of points, boxes, balls, segments or
 * hulls? */
#ifndef FROE_FORMATS_CSV_HEADER_H
#define FROE_FORMATS_CSV_HEADER_H
#include "formats/input/source.h"
#include "support/text/csv.h"

/** What a column holds. Corner c (0, or 1 for hi_ and to_) of axis a is c * FROE_MAX_DIM + a. */
enum {
    FORMATS_CSV_RADIUS = 2 * FROE_MAX_DIM,
    FORMATS_CSV_TAG,
    FORMATS_CSV_HULL,     /**< the number of the hull that the row is a corner of */
    FORMATS_CSV_NAME,     /**< of the group */
    FORMATS_CSV_GEOMETRY, /**< well-known text */
    FORMATS_CSV_LEFT_ALONE
};

typedef enum formats_csv_header {
    FORMATS_CSV_OURS,
    FORMATS_CSV_OTHER,  /**< none of these */
    FORMATS_CSV_BEYOND, /**< more axes than there can be */
    FORMATS_CSV_HALVES  /**< ends of boxes or segments, but not both on the same axes */
} formats_csv_header;

typedef struct formats_csv_table {
    char separator;
    froe_kind kind;
    int dim;
    int columns;    /**< 0: more than can be read */
    uint64_t lines; /**< of the header, which has line ends where names in quotation marks do */
    bool open;      /**< a quotation mark of the header is not closed */
    bool spare;     /**< the last column has no name: rows may end before it, as GDAL's of one attribute do */
    unsigned char role[SUPPORT_CSV_COLUMNS];
    char found[80]; /**< the names of the columns, for a sentence */
} formats_csv_table;

/** Reads the header line, which it changes, and moves `at` behind it. */
formats_csv_header formats_csv_read_header(char **at, formats_csv_table *table);
/** Does the header line say points, boxes, balls, segments or hulls, or try to? */
bool formats_csv_recognise(const formats_source *source);
/** Does the header line name a column of well-known text? */
bool formats_csv_has_geometry(const formats_source *source);
#endif
