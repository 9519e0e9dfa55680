/* json.h: a JSON text as values in one array, each followed by those within it.
 *
 *     [[1, 2], {"a": 3}]     array, array, 1, 2, object, "a", 3
 *
 * (jansson takes a number or a string that it has no memory for as a shorter one, or as bad syntax; its allocator is
 * one for the whole process. So this is read here.) */
#ifndef FROE_FORMATS_JSON_H
#define FROE_FORMATS_JSON_H
#include "support/array.h"

typedef enum formats_json_kind {
    FORMATS_JSON_NAME,
    FORMATS_JSON_NUMBER,
    FORMATS_JSON_STRING,
    FORMATS_JSON_ARRAY,
    FORMATS_JSON_OBJECT
} formats_json_kind;

typedef struct formats_json {
    formats_json_kind kind; /**< names are null, true and false */
    size_t count;           /**< values in an array, members of an object: each a string and a value */
    size_t span;            /**< values up to the next that is not within this one */
    double number;
    const char *text; /**< of a string: its characters, UTF-8, ended by zero; otherwise where it begins in the text */
} formats_json;
typedef ARRAY(formats_json) formats_json_values;

/** What is wrong with a text, and in which line, counted from 1. */
typedef struct formats_json_error {
    size_t line;
    char sentence[100];
} formats_json_error;

/** Reads `text` (RFC 8259), which lasts as long as the values: strings are decoded in it. text[length] is 0; a string
 * may not hold U+0000. Numbers are rounded to the nearest double in the locale of the thread, which is to be "C"; those
 * beyond the largest are refused. Without recursion, at any depth. FROE_E_MEMORY, FROE_E_FORMAT with `error`. */
froe_status formats_json_read(const froe_allocator *alloc, char *text, size_t length, formats_json_values *values,
                              formats_json_error *error);

/** Values may be NULL, which is of no kind and has nothing within it. */
static inline bool formats_json_is(const formats_json *value, formats_json_kind kind) {
    return value && value->kind == kind;
}
/** How many values an array holds; 0: it is none. */
static inline size_t formats_json_size(const formats_json *array) {
    return formats_json_is(array, FORMATS_JSON_ARRAY) ? array->count : 0;
}
/** The characters of a string, or NULL. */
static inline const char *formats_json_string(const formats_json *value) {
    return formats_json_is(value, FORMATS_JSON_STRING) ? value->text : NULL;
}
/** The value behind another and all within that. */
static inline const formats_json *formats_json_next(const formats_json *value) {
    return value + value->span;
}
/** For each value of an array: nothing where it is none. */
/* NOLINTBEGIN(bugprone-macro-parentheses): a name that is declared takes no parentheses */
#define FORMATS_JSON_EACH(item, array)                                                                                 \
    for (const formats_json *item = formats_json_size(array) ? (array) + 1 : NULL,                                     \
                            *item##_end = item ? formats_json_next(array) : NULL;                                      \
         item != item##_end; item = formats_json_next(item))
/* NOLINTEND(bugprone-macro-parentheses) */
/** The last member of an object that has this name; NULL: there is none, or it is no object. */
const formats_json *formats_json_get(const formats_json *object, const char *name);
#endif
