/* ranks.c: the order of objects within one plane, and the places of all pieces. */
#include "base/random.h"
#include "view/visibility/order.h"
#include "view/visibility/visibility.h"

/* Gives the objects of a patch the ranks from `first` on, in a random order. They do not hide each other. But the sides
 * of what comes first divide what comes later. Had thin triangles side by side the order of the scene, the beam tree
 * would be as high as they are many. */
static void shuffle_patch(const froe_surface *s, uint32_t patch, uint32_t first, uint32_t *ranks) {
    const uint32_t *members = s->members + s->patch_starts[patch],
                   count = s->patch_starts[patch + 1] - s->patch_starts[patch];
    for (uint32_t m = 0; m < count; m++) { /* each order alike: Fisher and Yates */
        const uint32_t other = base_below(base_hash(0, patch, m), m + 1);
        ranks[members[m]] = ranks[members[other]];
        ranks[members[other]] = first + m;
    }
}

/* The place of each object in the order of its patch: by priority, then by number. */
froe_status view_rank_objects(const froe_allocator *alloc, const froe_surface *s, const int32_t *priorities,
                              uint32_t **out) {
    const size_t n = s->patch_count, objects = s->scene->object_count;
    base_pair *pairs = support_calloc(alloc, 2 * n + 1, sizeof *pairs);
    uint32_t *ranks = *out = support_calloc(alloc, objects + 1, sizeof *ranks);
    const bool ok = pairs && ranks;
    for (uint32_t p = 0; ok && p < n; p++)
        pairs[p] = (base_pair){(uint64_t)((priorities ? (int64_t)priorities[p] : 0) - INT32_MIN), p};
    if (ok) base_radix_sort(pairs, pairs + n, n);
    for (uint32_t i = 0, first = 0; ok && i < n; i++) {
        const uint32_t p = pairs[i].value;
        shuffle_patch(s, p, first, ranks);
        first += s->patch_starts[p + 1] - s->patch_starts[p];
    }
    support_free(alloc, pairs, (2 * n + 1) * sizeof *pairs);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

froe_status view_find_places(const froe_visibility *v, const int32_t *priorities, uint32_t *places) {
    view_order order;
    uint32_t piece, place = 0, *ranks = NULL;
    froe_status status = view_rank_objects(&v->alloc, v->surface, priorities, &ranks);
    if (!status) {
        status = view_order_begin(&order, v->tree, &v->sights.eye, true, ranks);
        order.section = v->section;
        while (!status && view_order_next(&order, &piece)) places[piece] = place++;
        status = view_order_end(&order) ? FROE_E_MEMORY : status;
    }
    support_free(&v->alloc, ranks, ((size_t)v->surface->scene->object_count + 1) * sizeof *ranks);
    return status;
}
