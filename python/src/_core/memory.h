/* memory.h: the allocator of everything that the extension makes, and arrays of froe's that outlive what made them. */
#ifndef FROE_CORE_MEMORY_H
#define FROE_CORE_MEMORY_H
#include "core.h"

/** Of scenes, trees and answers: malloc, unless a test lets allocations fail (CORE_FAULTS). Usable on any thread. */
extern const froe_allocator core_allocator;
/** `count` items of `size` bytes, at least one byte; NULL: MemoryError is set. */
void *core_allocate(size_t count, size_t size);
void core_release(void *memory, size_t count, size_t size);

/** Takes over a block that ends by free_block(block, bytes): a capsule, which arrays hold. NULL: an exception is set,
 * and the block is freed. */
typedef void core_free_fn(void *block);
PyObject *core_owner(const void *block, size_t bytes, core_free_fn *free_block);

/** `count` items, or rows of `width` items where width is not 0, that lie in memory of `owner` every `stride` bytes
 * (0: one after the other): an object with the buffer protocol. format: one of "i" (int32), "q" (int64), "Q" (uint64),
 * "d", "B". */
PyObject *core_array(PyObject *owner, const void *data, const char *format, size_t count, size_t width, size_t stride);
/** Takes memory from core_allocate(), also on failure, for several arrays. */
PyObject *core_block(void *memory, size_t bytes);
/** How large such an array is, where its items lie one after the other. */
size_t core_array_bytes(const char *format, size_t count, size_t width);
/** An array of memory from core_allocate(), which it takes, also on failure. */
PyObject *core_array_of(void *memory, const char *format, size_t count, size_t width);
/** A tuple of objects, whose references it takes. NULL, without a leak, where one of them is NULL. */
PyObject *core_tuple(size_t count, PyObject *const *objects);

/** Bytes that grow. */
typedef struct core_pile {
    char *bytes;
    size_t count, room;
    bool full; /**< there was no memory for more */
} core_pile;
/** A froe_write_fn whose `user` is the pile: adds bytes, without the GIL. false: there is no memory. */
bool core_pile_put(void *pile, const void *bytes, size_t count);
void core_pile_free(core_pile *pile);
/** Takes the pile, also on failure, for arrays. */
PyObject *core_pile_owner(core_pile *pile);
#endif
