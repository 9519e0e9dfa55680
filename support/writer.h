/* writer.h: a file that appears whole or not at all.
 *
 *     write FOLDER/.froe-<16 hexadecimal digits>.tmp  ->  fsync  ->  rename to PATH  ->  fsync FOLDER
 *
 * Whatever goes wrong before the rename, the old file is as it was and the new one is removed; after it, the new one is
 * whole. A killed program leaves at most the temporary file. The new file has the mode of the old one, and its owner
 * and group where the system allows that.
 *
 * Where PATH is a link, what lies behind all links is replaced or made, and the links stay. What is no regular file (a
 * terminal, a pipe, a device) and what is named as a descriptor of this process (/dev/stdout, /dev/fd/3) is written as
 * it is. */
#ifndef FROE_SUPPORT_WRITER_H
#define FROE_SUPPORT_WRITER_H
#include <errno.h>
#include <froe/froe.h>

typedef struct support_writer {
    const char *path; /**< as the caller names it */
    froe_allocator alloc;
    froe_diagnostic *diag;
    struct support_writer_room *room;
    size_t filled; /**< bytes of the room's buffer */
    int file;      /**< the descriptor */
    int error;     /**< the first errno; nothing is written after it */
    bool shared;   /**< by several processes, which lock it */
} support_writer;

/** Begins a file; on success support_writer_close() must follow, and `path` must last until then. FROE_E_IO,
 * FROE_E_MEMORY. */
froe_status support_writer_open(support_writer *writer, const char *path, const froe_allocator *alloc,
                                froe_diagnostic *diag);
/** The same for a file that several processes write at places of their own. It grows as FOLDER/.NAME.writing, which is
 * locked as long as the writer lives. What a killed program left has no lock, and is used again. Where the file system
 * has no locks, it is as of support_writer_open(). FROE_E_IO, too: another program writes the file. */
froe_status support_writer_open_shared(support_writer *writer, const char *path, const froe_allocator *alloc,
                                       froe_diagnostic *diag);
/** Where the others write it; lives as long as the writer. NULL: it is no regular file, or the file system has no
 * locks, and support_writer_put() alone writes it. */
const char *support_writer_draft(const support_writer *writer);
/** Appends bytes. False once something could not be written, which support_writer_close() reports. */
bool support_writer_put(support_writer *writer, const void *bytes, size_t count);
/** With FROE_OK: brings the file to its place. Otherwise removes it. Returns `status`, or FROE_E_IO when something
 * could not be written. */
froe_status support_writer_close(support_writer *writer, froe_status status);

/** Does flock() fail so because the file system has no locks, as Lustre without its option? */
static inline bool support_no_locks(int error) {
    return error == ENOSYS || error == ENOLCK || error == EOPNOTSUPP;
}

/** All of a file at once. */
froe_status support_write(const char *path, const void *bytes, size_t count, const froe_allocator *alloc,
                          froe_diagnostic *diag);
#endif
