/* corner_index.c: ranks, the curve, boxes from the leaves up; and the search. */
#include "formats/input/corner_index.h"
#include "formats/input/orient.h"
#include <math.h>
#include <stdlib.h>

typedef struct spot {
    double x, y;
    uint64_t place; /* on the curve */
    uint32_t corner;
} spot;

/* ------------------------------------------------------------------ the curve -- */

static int by_x(const void *a, const void *b) {
    const spot *p = a, *q = b;
    return p->x != q->x ? (p->x < q->x ? -1 : 1) : p->y != q->y ? (p->y < q->y ? -1 : 1) : 0;
}

static int by_y(const void *a, const void *b) {
    const spot *p = a, *q = b;
    return p->y != q->y ? (p->y < q->y ? -1 : 1) : p->x != q->x ? (p->x < q->x ? -1 : 1) : 0;
}

static int by_place(const void *a, const void *b) {
    const spot *p = a, *q = b;
    return p->place != q->place ? (p->place < q->place ? -1 : 1) : 0;
}

/* Every bit of 32 at an even place. */
static uint64_t spread(uint64_t x) {
    x = (x | x << 16) & UINT64_C(0x0000ffff0000ffff);
    x = (x | x << 8) & UINT64_C(0x00ff00ff00ff00ff);
    x = (x | x << 4) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    x = (x | x << 2) & UINT64_C(0x3333333333333333);
    return (x | x << 1) & UINT64_C(0x5555555555555555);
}

/* ----------------------------------------------------------------- the levels -- */

static uint32_t parent(const formats_corner_index *index, uint32_t level, uint32_t entry) {
    return index->first[level + 1] + (entry - index->first[level]) / FORMATS_CORNER_FAN;
}

/* The boxes of all levels, from the places of the corners along the curve. */
static void fill_boxes(formats_corner_index *index, const spot *spots) {
    uint32_t entry = 0;
    for (uint32_t i = 0; i < index->count; ++i) {
        if (i && spots[i].place != spots[i - 1].place) ++entry;
        double *box = index->box[entry];
        box[0] = box[2] = spots[i].x;
        box[1] = box[3] = spots[i].y;
        index->place[spots[i].corner] = entry;
    }
    for (uint32_t level = 0; level + 1 < index->levels; ++level)
        for (uint32_t i = index->first[level]; i < index->first[level + 1]; ++i) {
            const double *from = index->box[i];
            double *to = index->box[parent(index, level, i)];
            bool begins = (i - index->first[level]) % FORMATS_CORNER_FAN == 0;
            for (int k = 0; k < 2; ++k) {
                if (begins || from[k] < to[k]) to[k] = from[k];
                if (begins || from[k + 2] > to[k + 2]) to[k + 2] = from[k + 2];
            }
        }
}

bool formats_corner_index_new(const froe_allocator *alloc, const double *xy, uint32_t count,
                              formats_corner_index *out) {
    spot *spots = support_calloc(alloc, count, sizeof *spots);
    *out = (formats_corner_index){.count = count};
    if (!spots) return false;
    for (uint32_t i = 0; i < count; ++i) spots[i] = (spot){xy[2 * i], xy[2 * i + 1], 0, i};
    /* Corners in one place have equal ranks on both axes, and no others do. */
    uint32_t rank = 0;
    qsort(spots, count, sizeof *spots, by_x);
    for (uint32_t i = 0; i < count; ++i) {
        if (i && by_x(spots + i - 1, spots + i)) ++rank;
        spots[i].place = spread(rank);
    }
    rank = 0;
    qsort(spots, count, sizeof *spots, by_y);
    for (uint32_t i = 0, last = 0; i < count; last = i++) {
        if (by_y(spots + last, spots + i)) ++rank;
        spots[i].place |= spread(rank) << 1;
    }
    qsort(spots, count, sizeof *spots, by_place);
    uint32_t width = 0; /* of level 0: places that differ */
    for (uint32_t i = 0; i < count; ++i) width += !i || spots[i].place != spots[i - 1].place;
    while (width) {
        out->first[out->levels + 1] = out->first[out->levels] + width;
        ++out->levels;
        width = width > 1 ? (width + FORMATS_CORNER_FAN - 1) / FORMATS_CORNER_FAN : 0;
    }
    const size_t entries = out->first[out->levels];
    out->box = support_calloc(alloc, entries, sizeof *out->box);
    out->marks = support_calloc(alloc, entries, sizeof *out->marks);
    out->place = support_calloc(alloc, count, sizeof *out->place);
    const bool room = out->box && out->marks && out->place;
    if (room) fill_boxes(out, spots);
    support_free(alloc, spots, count * sizeof *spots);
    return room;
}

void formats_corner_index_free(const froe_allocator *alloc, formats_corner_index *index) {
    const size_t entries = index->first[index->levels];
    support_free(alloc, index->box, entries * sizeof *index->box);
    support_free(alloc, index->marks, entries * sizeof *index->marks);
    support_free(alloc, index->place, index->count * sizeof *index->place);
    *index = (formats_corner_index){0};
}

void formats_corner_index_mark(formats_corner_index *index, uint32_t corner, bool marked) {
    uint32_t entry = index->place[corner];
    for (uint32_t level = 0; level < index->levels; ++level) {
        if (marked)
            ++index->marks[entry];
        else
            --index->marks[entry];
        if (level + 1 < index->levels) entry = parent(index, level, entry);
    }
}

/* ----------------------------------------------------------------- the search -- */

/* Is all of a box certainly right of the line from a to b? Its corner furthest to the left is: the filter of
 * formats_orient(), about that corner. */
static bool right_of(const double *box, const double *a, const double *b) {
    double dx = b[0] - a[0], dy = b[1] - a[1];
    double left = dx * (box[dx > 0 ? 3 : 1] - a[1]), right = dy * (box[dy > 0 ? 0 : 2] - a[0]);
    return right - left > FORMATS_ORIENT_BOUND * (fabs(left) + fabs(right));
}

static double least(double a, double b, double c) {
    a = b < a ? b : a;
    return c < a ? c : a;
}

static bool same_place(const double *p, const double *q) {
    return p[0] == q[0] && p[1] == q[1];
}

bool formats_corner_index_any(const formats_corner_index *index, const double *a, const double *b, const double *c) {
    struct {
        uint32_t level, entry;
    } stack[FORMATS_CORNER_FAN * FORMATS_CORNER_LEVELS], at;
    uint32_t top = 0;
    if (!index->levels) return false;
    stack[top].level = index->levels - 1;
    stack[top++].entry = index->first[index->levels - 1];
    while (top) {
        at = stack[--top];
        const double *box = index->box[at.entry];
        bool beside = !index->marks[at.entry];
        for (int k = 0; k < 2 && !beside; ++k)
            beside = box[k] > -least(-a[k], -b[k], -c[k]) || box[k + 2] < least(a[k], b[k], c[k]);
        if (beside || right_of(box, a, b) || right_of(box, b, c) || right_of(box, c, a)) continue;
        if (!at.level) {
            if (!same_place(box, a) && !same_place(box, b) && !same_place(box, c) && formats_orient(a, b, box) >= 0 &&
                formats_orient(b, c, box) >= 0 && formats_orient(c, a, box) >= 0)
                return true;
            continue;
        }
        uint32_t child = index->first[at.level - 1] + (at.entry - index->first[at.level]) * FORMATS_CORNER_FAN;
        for (uint32_t i = 0; i < FORMATS_CORNER_FAN && child + i < index->first[at.level]; ++i) {
            stack[top].level = at.level - 1;
            stack[top++].entry = child + i;
        }
    }
    return false;
}
