/* pictures.h: pictures of partitions in memory. */
#ifndef FROE_TESTS_DRAW_PICTURES_H
#define FROE_TESTS_DRAW_PICTURES_H
#include "support/small_scenes.h"
#include <cairo.h>
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
typedef struct picture_reader {
    image_bytes p;
    size_t at;
} picture_reader;

static inline cairo_status_t read_some(void *user, unsigned char *data, unsigned length) {
    picture_reader *r = user;
    if (r->p.count - r->at < length) return CAIRO_STATUS_READ_ERROR;
    memcpy(data, r->p.bytes + r->at, length);
    r->at += length;
    return CAIRO_STATUS_SUCCESS;
}

static inline cairo_surface_t *image_of(image_bytes p) {
    picture_reader r = {p, 0};
    cairo_surface_t *image = cairo_image_surface_create_from_png_stream(read_some, &r);
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    return image;
}

static inline uint32_t pixel(cairo_surface_t *image, int x, int y) {
    const unsigned char *row = cairo_image_surface_get_data(image) + y * cairo_image_surface_get_stride(image);
    uint32_t value;
    memcpy(&value, row + 4 * x, 4);
    return value & 0xFFFFFF;
}

static inline int lightness(uint32_t rgb) {
    return (int)((rgb >> 16) + (rgb >> 8 & 255) + (rgb & 255));
}
#endif
