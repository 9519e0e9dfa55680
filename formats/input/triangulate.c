/* triangulate.c: ear clipping (Meisters, "Polygons have ears", 1975) for the polygons that cannot stay whole.
 *
 * Every choice is by exact signs. Where exponents leave the range of doubles the
 * sign may be wrong; then the triangles are less fair but still the same number,
 * with the same corners and the same outline. */
#include "formats/input/triangulate.h"
#include "formats/input/corner_index.h"
#include "formats/input/orient.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool same_corner(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1];
}

int formats_ring_side(const double *xy, size_t count) {
    size_t low = 0, before, after;
    for (size_t i = 1; i < count; ++i) {
        const double *p = xy + 2 * i, *q = xy + 2 * low;
        if (p[0] < q[0] || (p[0] == q[0] && p[1] < q[1])) low = i;
    }
    for (before = low; before != (low + 1) % count && same_corner(xy + 2 * before, xy + 2 * low);)
        before = (before + count - 1) % count;
    for (after = low; after != before && same_corner(xy + 2 * after, xy + 2 * low);) after = (after + 1) % count;
    return formats_orient(xy + 2 * before, xy + 2 * low, xy + 2 * after);
}

/* ------------------------------------------------------------------ ears -- */

#define NO_EAR UINT32_MAX
enum { WORD = 64, SET_LEVELS = 6 };

/* Which corners are ears? A bit each; above, a bit for each word that is not 0, and so on. */
typedef struct ear_set {
    uint64_t *words[SET_LEVELS];
    uint32_t count, levels;
} ear_set;

typedef struct outline {
    const double *xy; /* the shadow: 2 doubles per corner, turning left as a whole */
    uint32_t *next, *before;
    bool *dull;
    formats_corner_index index;
    ear_set ears;
    formats_indices *triangles;
    uint32_t left;    /* corners not clipped yet */
    uint32_t clipped; /* corners since all were tested */
} outline;

static void set_ear(ear_set *set, uint32_t corner, bool ear) {
    for (uint32_t level = 0; level < set->levels; ++level, corner /= WORD) {
        uint64_t *word = set->words[level] + corner / WORD, bit = UINT64_C(1) << corner % WORD;
        *word = ear ? *word | bit : *word & ~bit;
        if (!ear && *word) return;
    }
}

/* The first ear from a corner on, or NO_EAR. Up while the rest of a word is 0, then down. */
static uint32_t next_ear(const ear_set *set, uint32_t from) {
    uint32_t count = set->count;
    for (uint32_t level = 0; level < set->levels && from < count; ++level) {
        uint64_t rest = set->words[level][from / WORD] >> from % WORD;
        count = (count + WORD - 1) / WORD;
        if (!rest) {
            from = from / WORD + 1;
            continue;
        }
        from += (uint32_t)__builtin_ctzll(rest);
        while (level--) from = from * WORD + (uint32_t)__builtin_ctzll(set->words[level][from]);
        return from;
    }
    return NO_EAR;
}

/* Reflex and straight corners are called dull; only these are marked in the index. */
static void look_at_turn(outline *o, uint32_t b) {
    bool dull = formats_orient(o->xy + 2 * o->before[b], o->xy + 2 * b, o->xy + 2 * o->next[b]) <= 0;
    if (dull != o->dull[b]) formats_corner_index_mark(&o->index, b, dull);
    o->dull[b] = dull;
}

/* A corner is an ear if it is not dull, and no other lies in the triangle of it and its neighbours. If any lies there,
 * so does a dull one: that which is furthest from the side between the neighbours. So only these are looked for, and
 * while a simple polygon is clipped, what a corner is changes only when a neighbour of it goes. */
static void look_at_ear(outline *o, uint32_t b) {
    const double *pa = o->xy + 2 * o->before[b], *pb = o->xy + 2 * b, *pc = o->xy + 2 * o->next[b];
    set_ear(&o->ears, b, !o->dull[b] && !formats_corner_index_any(&o->index, pa, pb, pc));
}

static void look_at_all(outline *o, uint32_t from) {
    uint32_t b = from;
    do look_at_turn(o, b);
    while ((b = o->next[b]) != from);
    do look_at_ear(o, b);
    while ((b = o->next[b]) != from);
    o->clipped = 0;
}

/* False: no memory. */
static bool clip_all(const froe_allocator *alloc, outline *o) {
    uint32_t from = 1; /* the fan of a convex polygon starts at its corner 0 */
    look_at_all(o, 0);
    while (o->left >= 3) {
        /* The next ear from `from` on; without one (flat, or not simple) `from` itself. Where the polygon is not simple
         * there may be ears that are not known: all corners are tested again, once enough of them have gone since. */
        uint32_t b = next_ear(&o->ears, from);
        if (b == NO_EAR) b = next_ear(&o->ears, 0);
        if (b == NO_EAR && o->clipped && o->clipped >= o->left / 8) {
            look_at_all(o, from);
            continue;
        }
        if (b == NO_EAR) b = from;
        const uint32_t a = o->before[b], c = o->next[b], triangle[3] = {a, b, c};
        if (!array_append(alloc, o->triangles, triangle, 3)) return false;
        o->next[a] = c;
        o->before[c] = a;
        --o->left;
        ++o->clipped;
        set_ear(&o->ears, b, false);
        if (o->dull[b]) formats_corner_index_mark(&o->index, b, false);
        look_at_turn(o, a);
        look_at_turn(o, c);
        look_at_ear(o, a);
        look_at_ear(o, c);
        from = c;
    }
    return true;
}

/* The axis along which the polygon is widest seen (that of Newell's normal, 1972), and
 * in `flip` whether the shadow turns right. Coordinates are first scaled by a power of 2. */
static int main_axis(const double *corners, size_t count, bool *flip) {
    double most = 0, normal[3] = {0, 0, 0};
    for (size_t i = 0; i < 3 * count; ++i) most = fabs(corners[i]) > most ? fabs(corners[i]) : most;
    int exponent;
    frexp(most, &exponent);
    const double *o = corners;
    for (size_t i = 1; i + 1 < count; ++i) {
        double u[3], v[3];
        for (int k = 0; k < 3; ++k) {
            u[k] = ldexp(corners[3 * i + k], -exponent) - ldexp(o[k], -exponent);
            v[k] = ldexp(corners[3 * i + 3 + k], -exponent) - ldexp(o[k], -exponent);
        }
        for (int k = 0; k < 3; ++k) normal[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (fabs(normal[k]) > fabs(normal[axis])) axis = k;
    *flip = normal[axis] < 0;
    return axis;
}

bool formats_triangulate(const froe_allocator *alloc, const double *corners, size_t count, formats_indices *triangles) {
    if (count > UINT32_MAX / 2) return false;
    outline o = {.triangles = triangles, .left = (uint32_t)count};
    size_t words = 0, at = 0;
    uint32_t level_words[SET_LEVELS];
    o.ears.count = o.left;
    for (uint32_t bits = o.left; !o.ears.levels || bits > 1; bits = level_words[o.ears.levels++])
        words += level_words[o.ears.levels] = (bits + WORD - 1) / WORD;
    double *xy = support_calloc(alloc, 2 * count, sizeof *xy);
    uint32_t *links = support_calloc(alloc, 2 * count, sizeof *links);
    uint64_t *ears = support_calloc(alloc, words, sizeof *ears);
    o.dull = support_calloc(alloc, count, sizeof *o.dull);
    bool done = xy && links && ears && o.dull;
    if (done) {
        bool flip;
        const int axis = main_axis(corners, count, &flip), first = (axis + 1) % 3, second = (axis + 2) % 3;
        o.xy = xy;
        o.next = links;
        o.before = links + count;
        for (uint32_t i = 0; i < o.left; ++i) {
            xy[2 * i] = corners[3 * i + (size_t)(flip ? second : first)];
            xy[2 * i + 1] = corners[3 * i + (size_t)(flip ? first : second)];
            o.next[i] = i + 1 < o.left ? i + 1 : 0;
            o.before[i] = i ? i - 1 : o.left - 1;
        }
        for (uint32_t level = 0; level < o.ears.levels; at += level_words[level++]) o.ears.words[level] = ears + at;
        done = formats_corner_index_new(alloc, xy, o.left, &o.index) && clip_all(alloc, &o);
    }
    formats_corner_index_free(alloc, &o.index);
    support_free(alloc, xy, 2 * count * sizeof *xy);
    support_free(alloc, links, 2 * count * sizeof *links);
    support_free(alloc, ears, words * sizeof *ears);
    support_free(alloc, o.dull, count * sizeof *o.dull);
    return done;
}
