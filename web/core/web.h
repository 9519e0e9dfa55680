/* web.h: what the module exports beside public functions: those whose arguments JavaScript cannot give as numbers
 * and addresses.
 *
 * Public functions that take and give pointers and numbers alone are exported as they are (web/CMakeLists.txt), and
 * package/core.js reads and writes their structs; layout.c asserts where the members are. Options are structs that
 * JavaScript does not know: it sets their members by name. Arrays come as addresses in the memory of the module.
 * Text is UTF-8 and ends with a zero byte. */
#ifndef FROE_WEB_H
#define FROE_WEB_H

#include <emscripten.h>
#include <froe/froe.h>

#define WEB_EXPORT EMSCRIPTEN_KEEPALIVE

/** What a member of a struct of options is. */
typedef enum web_type {
    WEB_BOOL,
    WEB_INT,     /**< unsigned, size_t, int that is not negative: all of 4 bytes */
    WEB_SIGNED,  /**< int */
    WEB_UINT64,  /**< a whole number below 2^53: all of these are numbers of JavaScript */
    WEB_DOUBLE,  /**< any number, and infinities */
    WEB_VECTOR,  /**< three doubles: the axis is a part of the name, as in "eye.0" */
    WEB_ADDRESS, /**< of an array, which must live as long as the options */
    WEB_TEXT,    /**< so must a text */
    WEB_NAMED,   /**< an enumeration whose values 0, 1, ... have names */
    WEB_BITS     /**< a set of bits 1, 2, 4, ..., which have names */
} web_type;

/** A member of a struct, as JavaScript calls it. */
typedef struct web_member {
    const char *name;
    web_type type;
    size_t offset;
    const char *(*value_name)(int value); /**< of WEB_NAMED and WEB_BITS; NULL past the last */
} web_member;

/** A kind of options. */
typedef struct web_kind {
    const char *name;
    size_t size;
    void (*defaults)(void *options); /**< one thread, and web_progress() */
    const web_member *members;       /**< ended by a NULL name */
} web_kind;
extern const web_kind web_objects, web_read_options, web_build_options, web_batch, web_range, web_audit;
extern const web_kind web_render_options, web_line_style, web_export_options;
extern const web_kind web_motion, web_moving, web_body, web_contacts, web_kinetic, web_snapshot;

/** FROE_E_MEMORY, with its sentence. */
froe_status web_no_memory(froe_diagnostic *diag);

/** Bytes that grow: what froe writes to a function, and records that its visitors collect. Freed by
 * web_bytes_free(). */
typedef struct web_bytes {
    unsigned char *at;
    size_t count, room;
    bool no_memory;
} web_bytes;
/** Adds bytes. A froe_write_fn whose user is a web_bytes. */
bool web_bytes_take(void *user, const void *bytes, size_t count);
/** What a call that filled them returns: `status`, unless memory was short. Frees them if it has failed. */
froe_status web_bytes_end(web_bytes *all, froe_status status, froe_diagnostic *diag);
/** Leaves none. */
void web_bytes_free(web_bytes *all);

/** A progress function, whose `user` does not count: asks JavaScript whether to go on. */
bool web_progress(void *user, double done);

#endif
