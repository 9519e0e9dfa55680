/* common.h: what readers, writers and generators share: memory, failures, locale. */
#ifndef FROE_FORMATS_COMMON_H
#define FROE_FORMATS_COMMON_H

#include "support/alloc.h"
#include "support/fail.h"
#include <froe/formats.h>
#include <locale.h>

/** A growable run of bytes, used as an array of any plain type. Zero is empty. */
typedef struct formats_buffer {
    void *data;
    size_t size, capacity; /**< bytes */
} formats_buffer;
/** Room for `bytes` more, counted as used; a pointer to them, or NULL without memory (nothing changes).
 * The pointer holds until the next call. */
void *formats_buffer_add(const froe_allocator *alloc, formats_buffer *buffer, size_t bytes);
bool formats_buffer_put(const froe_allocator *alloc, formats_buffer *buffer, const void *item, size_t bytes);
void formats_buffer_free(const froe_allocator *alloc, formats_buffer *buffer);

/** FROE_E_IO, or FROE_E_MEMORY where `error` is ENOMEM: what an errno value says about a file. */
froe_status formats_fail_file(froe_diagnostic *diag, const char *path, int error);
/** While a file is read or written the calling thread uses the C locale: a decimal point is a point. */
typedef struct formats_locale {
    locale_t own, before;
} formats_locale;
bool formats_locale_enter(formats_locale *guard); /**< false: no memory */
void formats_locale_leave(formats_locale *guard);

/** Seconds of a clock that only goes forward. */
double formats_seconds(void);

/** The extension of a path in lower case, without the dot, "" if there is none (or none that fits). */
typedef struct formats_extension {
    char text[16];
} formats_extension;
formats_extension formats_path_extension(const char *path);
bool formats_equal_nocase(const char *a, const char *b); /**< ASCII letters only */

#endif
