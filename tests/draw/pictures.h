/* pictures.h: pictures of partitions in memory. */
#ifndef FROE_TESTS_DRAW_PICTURES_H
#define FROE_TESTS_DRAW_PICTURES_H
#include "support/small_scenes.h"
#include <froe/draw.h>

typedef struct image_bytes {
    char *bytes;
    size_t count;
} image_bytes;

static inline bool keep_picture(void *user, const void *bytes, size_t count) {
    image_bytes *p = user;
    p->bytes = realloc(p->bytes, p->count + count + 1);
    assert_non_null(p->bytes);
    memcpy(p->bytes + p->count, bytes, count);
    p->count += count;
    p->bytes[p->count] = 0;
    return true;
}

static inline image_bytes picture_of(const froe_tree *tree, froe_draw_format format, const froe_draw_options *options) {
    image_bytes p = {NULL, 0};
    froe_diagnostic diag = {.message = ""};
    froe_status status = froe_draw_write(tree, format, keep_picture, &p, options, &diag);
    if (status != FROE_OK) fail_msg("%s", diag.message);
    return p;
}

static inline void assert_same_picture(image_bytes a, image_bytes b) {
    assert_int_equal(a.count, b.count);
    assert_memory_equal(a.bytes, b.bytes, a.count);
    free(a.bytes);
    free(b.bytes);
}
#endif
