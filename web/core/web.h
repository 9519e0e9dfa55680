/* web.h: what the module exports beside public functions: those whose arguments JavaScript cannot give as numbers
 * and addresses.
 *
 * Public functions that take and give pointers and numbers alone are exported as they are (see
 * web/CMakeLists.txt), and package/core.js reads the structs that they fill; layout.c asserts where their members are.
 * Options are structs that JavaScript does not know: it sets their members by name. Arrays come as addresses in the
 * memory of the module. Text is UTF-8 and ends with a zero byte. */
#ifndef FROE_WEB_H
#define FROE_WEB_H

#include <emscripten.h>
#include <froe/froe.h>

#define WEB_EXPORT EMSCRIPTEN_KEEPALIVE

/** What a member of a struct of options is. */
typedef enum web_type {
    WEB_BOOL,
    WEB_INT,    /**< int, unsigned and enumerations: all of 4 bytes */
    WEB_UINT64, /**< a whole number, at most 2^53 */
    WEB_DOUBLE,
    WEB_VECTOR,  /**< three doubles: the axis is a part of the name, as in "eye.0" */
    WEB_ADDRESS, /**< of a text or an array, which must live as long as the options */
    WEB_NAMED    /**< an enumeration whose values have names */
} web_type;

/** A member of a struct, as JavaScript calls it. */
typedef struct web_member {
    const char *name;
    web_type type;
    size_t offset;
    const char *(*value_name)(int value); /**< WEB_NAMED */
} web_member;

/** Sets a member to a number, for WEB_ADDRESS to an address. The table ends with a NULL name. FROE_E_OPTIONS: no such
 * member, or no whole number where one is asked for. */
froe_status web_set_number(void *options, const web_member *table, const char *name, double value,
                           froe_diagnostic *diag);
/** Sets a member by the name of its value. FROE_E_OPTIONS: no such member, or no such value. */
froe_status web_set_name(void *options, const web_member *table, const char *name, const char *value,
                         froe_diagnostic *diag);

/** FROE_E_MEMORY, with its sentence. */
froe_status web_no_memory(froe_diagnostic *diag);

/** Bytes that grow: what froe writes to a function. */
typedef struct web_bytes {
    unsigned char *at;
    size_t count, room;
    bool no_memory;
} web_bytes;
/** A froe_write_fn whose user is a web_bytes. */
bool web_bytes_take(void *user, const void *bytes, size_t count);
/** Gives the bytes away, if `status` is FROE_OK; otherwise frees them. Returns what has failed. */
froe_status web_bytes_end(web_bytes *all, froe_status status, void **bytes, size_t *count, froe_diagnostic *diag);

/** Tells the page how far a call is; for callbacks, whose `user` does not count. Always true: a page
 * that wants to cancel ends the worker. */
bool web_progress(void *user, double done);

#endif
