/* support.h: what tests of the core's formats share, by the reader of every format. */
#ifndef FROE_TESTS_IO_SUPPORT_H
#define FROE_TESTS_IO_SUPPORT_H
#include <froe/io.h>
#define FROE_TEST_READ froe_read
#include "support/memory.h"
#include "support/scenes.h"

/** For test_memory_each(): reads the scene of a file. */
static inline froe_status read_with_memory(void *path, const froe_allocator *alloc) {
    froe_read_options o = froe_read_defaults();
    froe_scene *scene = NULL;
    o.alloc = alloc;
    const froe_status status = froe_read(path, &o, &scene, NULL, NULL);
    froe_scene_free(scene);
    return status;
}
#endif
