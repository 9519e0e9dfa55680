/* common.h: what readers, writers and generators share: memory, failures, locale.
 * The io library stands on the public API alone, so it has its own few lines of each. */
#ifndef FROE_IO_COMMON_H
#define FROE_IO_COMMON_H

#include <froe/io.h>
#include <locale.h>

/** The caller's allocator, or malloc. */
froe_allocator io_allocator(const froe_allocator *alloc);

/** A growable run of bytes, used as an array of any plain type. Zero is empty. */
typedef struct io_buffer {
    void *data;
    size_t size, capacity; /**< bytes */
} io_buffer;
/** Room for `bytes` more, counted as used; a pointer to them, or NULL without memory (nothing changes).
 * The pointer holds until the next call. */
void *io_buffer_add(const froe_allocator *alloc, io_buffer *buffer, size_t bytes);
bool io_buffer_put(const froe_allocator *alloc, io_buffer *buffer, const void *item, size_t bytes);
void io_buffer_free(const froe_allocator *alloc, io_buffer *buffer);

/** Fills `diag` (unless NULL) with a printf-formatted sentence and returns `status`. */
froe_status io_fail(froe_diagnostic *diag, froe_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
froe_status io_fail_memory(froe_diagnostic *diag);
/** FROE_E_IO, or FROE_E_MEMORY where `error` is ENOMEM: what an errno value says about a file. */
froe_status io_fail_file(froe_diagnostic *diag, const char *path, int error);
/** The end of a path, short enough to leave room for the reason in a diagnostic. */
const char *io_short(const char *path);
/** "Why" of an errno value, from the calling thread's own buffer. */
typedef struct io_reason {
    char text[96];
} io_reason;
io_reason io_errno(int error);

/** While a file is read or written the calling thread uses the C locale: a decimal point is a point. */
typedef struct io_locale {
    locale_t own, before;
} io_locale;
bool io_locale_enter(io_locale *guard); /**< false: no memory */
void io_locale_leave(io_locale *guard);

/** Seconds of a clock that only goes forward. */
double io_seconds(void);

/** The extension of a path in lower case, without the dot, "" if there is none (or none that fits). */
typedef struct io_extension {
    char text[16];
} io_extension;
io_extension io_path_extension(const char *path);
bool io_equal_nocase(const char *a, const char *b); /**< ASCII letters only */

#endif
