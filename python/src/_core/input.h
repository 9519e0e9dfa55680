/* input.h: arrays of the caller, by the buffer protocol.
 *
 * A call works on what the array held when it began: other threads may write into it meanwhile, and what froe has
 * checked must not change under it. So the items are copied, which takes far less time than any call, unless the array
 * is read-only: then it is used where it lies. Views that are read-only while the array that they show is not, are
 * copied by the package (src/froe/_arrays.py). */
#ifndef FROE_CORE_INPUT_H
#define FROE_CORE_INPUT_H
#include "core.h"

typedef struct core_input {
    const void *data; /**< NULL: the argument was None */
    size_t count;     /**< rows: items / width */
    Py_buffer view;   /**< of an array that is used where it lies */
    void *copy;
    size_t bytes;
} core_input;

/** C-contiguous items of one type, `width` to a row: 'd' (float64), 'I' (uint32, or int32 of the same bits) or 'Q'
 * (uint64). The message of a failure calls the array `name`. None is allowed where `optional`. false: an exception is
 * set, and nothing is to be freed. */
bool core_input_take(core_input *in, PyObject *object, const char *name, char format, size_t width, bool optional);
/** The same, and there must be `count` rows. */
bool core_input_take_count(core_input *in, PyObject *object, const char *name, char format, size_t width, size_t count,
                           bool optional);
/** Zero-initialised inputs are accepted. */
void core_input_give(core_input *in);
#endif
