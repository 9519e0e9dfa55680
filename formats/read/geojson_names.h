/* geojson_names.h: what features of GeoJSON are called, and their numbers, by the rules that GDAL has for all features
 * of a file together (ogr/ogrsf_frmts/geojson, GDAL 3.6):
 *
 *     number   the member `id` of a feature, where these are whole numbers; or else the property `id`, where these are;
 *              features without one are counted from 0
 *     name     the property name, title or label, the first of them that any feature of the file has; or else id
 *     texts    of whole numbers and strings; strings are dates where all of a property are
 *
 * What depends on features that were not read yet, such as numbers among texts, is left to GDAL. */
#ifndef FROE_FORMATS_GEOJSON_NAMES_H
#define FROE_FORMATS_GEOJSON_NAMES_H
#include "formats/input/outline.h"
#include "formats/read/json_scan.h"

typedef enum geojson_column {
    GEOJSON_NAME,
    GEOJSON_TITLE,
    GEOJSON_LABEL,
    GEOJSON_ID,
    GEOJSON_LAYER,
    GEOJSON_COLUMNS
} geojson_column;

/** A value of a property or member that names something. */
typedef struct geojson_value {
    enum { GEOJSON_ABSENT, GEOJSON_NULL, GEOJSON_TEXT, GEOJSON_WHOLE } kind;
    const char *text; /**< ended with a NUL, in place */
    int64_t number;
} geojson_value;

/** Of the features so far; begins as zeros. */
typedef struct geojson_names {
    struct {
        const char *spelling; /**< in the text; NULL: no feature had it */
        bool dates, words;    /**< strings that may be dates; that are none */
    } columns[GEOJSON_COLUMNS];
    int named;                   /**< 1 + which column names features; 0: none yet */
    bool numbers, texts;         /**< members `id` were whole numbers; were strings */
    bool own_numbers, own_texts; /**< the same of properties `id` */
    bool own;                    /**< a feature had the property `id` */
    int64_t next;                /**< number of the next feature that has none */
} geojson_names;

typedef struct geojson_feature {
    geojson_value id, columns[GEOJSON_COLUMNS];
} geojson_feature;

/** The strings of a feature: in its values, or printed here; "": it has none. */
typedef struct geojson_labels {
    int64_t number;
    const char *name, *id, *material;
    char printed[3][24];
} geojson_labels;

/** Reads the member `id` of a feature. False: it is odd. */
bool geojson_read_id(char **at, geojson_feature *feature);
/** Reads the properties of a feature, behind the brace. */
bool geojson_read_properties(char **at, geojson_names *names, geojson_feature *feature);
/** All members of a feature were read: what is it called? */
bool geojson_label(geojson_names *names, const geojson_feature *feature, geojson_labels *out);
/** All features were read: was what they are called right? */
bool geojson_names_right(const geojson_names *names);

#endif
