/* space.c: writing blocks of space.
 *
 * The frame begins at the least corner and is the smallest power of 2 that holds all corners and bounds. With a scale
 * that is a power of 2, (x - lo) * scale suffers one rounding, of a number below 2^16, so half a unit at most is lost
 * in rounding and 2^-37 in the difference. */
#include "tree/packed/space.h"
#include <math.h>

bool space_is_tame(const double *lo, const double *hi) {
    double most = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        most = fmax(most, fmax(fabs(lo[k]), fabs(hi[k])));
        size = fmax(size, hi[k] - lo[k]);
    }
    return most <= 0x1p400 && size >= 0x1p-400;
}

uint32_t space_sort(space_item *items, uint32_t count) {
    uint32_t triangles = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (items[i].corner == FROE_NONE) continue;
        if (i == triangles++) continue;
        space_item item = items[i];
        items[i] = items[triangles - 1];
        items[triangles - 1] = item;
    }
    return triangles;
}

typedef struct space_bounds {
    double lo[3], hi[3];
} space_bounds;

static void grow_bounds(space_bounds *b, const double *lo, const double *hi) {
    for (int k = 0; k < 3; k++) {
        b->lo[k] = lo[k] < b->lo[k] ? lo[k] : b->lo[k];
        b->hi[k] = hi[k] > b->hi[k] ? hi[k] : b->hi[k];
    }
}

/* Rounded down. */
static uint16_t unit_of_bound(double x, double lo, double scale, double up) {
    const double u = (x - lo) * scale + up;
    return (uint16_t)(u > 0 ? u < PACKED_UNITS ? (int32_t)u : PACKED_UNITS : 0);
}

/* Rounded up; x is no more than PACKED_UNITS above lo. */
static uint16_t unit_above(double x, double lo, double scale) {
    const double u = (x - lo) * scale;
    const uint16_t below = unit_of_bound(x, lo, scale, 0);
    return (uint16_t)(below + (u > below));
}

/* 65535 / size, rounded down to a power of 2; 0 where numbers are too large or too small for it. */
static double scale_for(const space_bounds *b) {
    double size = 0, most = 0;
    int exponent;
    for (int k = 0; k < 3; k++) {
        most = fmax(most, fmax(fabs(b->lo[k]), fabs(b->hi[k])));
        size = fmax(size, b->hi[k] - b->lo[k]);
    }
    if (most > 0x1p400) return 0;
    if (size < 0x1p-600) return 0x1p600;
    frexp(size, &exponent);
    double scale = ldexp(1, 16 - exponent); /* size * scale in [2^15, 2^16) */
    return size * scale <= PACKED_UNITS ? scale : scale / 2;
}

void space_write(space_header *h, const froe_scene *s, const space_item *items, uint32_t count, uint32_t triangles) {
    space_bounds frame = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}, parts = frame;
    uint32_t *ids = (uint32_t *)(void *)(h + 1);
    for (uint32_t i = 0; i < count; i++) space_ask(s, items + i);
    for (uint32_t i = 0; i < count; i++) space_ask_corners(s, items + i);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t object = items[i].object;
        grow_bounds(&parts, items[i].lo, items[i].hi);
        for (uint32_t c = 0; i < triangles && c < 3; c++) {
            const double *x = space_corner(s, items + i, c);
            grow_bounds(&frame, x, x);
        }
        const bool exact = i >= triangles && (scene_form(s, object) == FROE_BOX || scene_form(s, object) == FROE_POINT);
        ids[i] = object | (exact ? SPACE_EXACT : 0);
    }
    if (count) grow_bounds(&frame, parts.lo, parts.hi);
    h->count = count;
    h->triangles = triangles;
    h->scale = count ? scale_for(&frame) : 0;
    if (h->scale == 0) return;
    for (int k = 0; k < 3; k++) {
        h->lo[k] = frame.lo[k] + 0.0; /* no -0 */
        h->box[0][k] = unit_of_bound(parts.lo[k], h->lo[k], h->scale, 0);
        h->box[1][k] = unit_above(parts.hi[k], h->lo[k], h->scale);
    }
    uint16_t *rows = (uint16_t *)(void *)(ids + count);
    const size_t n = count, m = triangles;
    for (size_t i = 0; i < m; i++)
        for (uint32_t c = 0; c < 3; c++) {
            const double *x = space_corner(s, items + i, c);
            for (size_t k = 0; k < 3; k++)
                rows[c < 2 ? (3 * c + k) * n + i : 6 * n + k * m + i] = unit_of_bound(x[k], h->lo[k], h->scale, 0.5);
        }
    for (size_t i = m; i < n; i++)
        for (size_t k = 0; k < 3; k++) {
            rows[k * n + i] = unit_of_bound(items[i].lo[k], h->lo[k], h->scale, 0);
            rows[(3 + k) * n + i] = unit_above(items[i].hi[k], h->lo[k], h->scale);
        }
}
