/* chord.c: see chord.h. */
#include "build/conversion/chord.h"
#include "base/random.h"
#include "geom/filter.h"

enum { CHORD = 1, OTHER = 2, ROUNDS = 64 };

void chord_free(const froe_allocator *alloc, chord_search *search) {
    array_free(alloc, &search->items);
    array_free(alloc, &search->chords);
}

bool chord_begin(chord_search *search, const split_set *set, const split_cell *cell) {
    search->items.count = search->chords.count = 0;
    return array_reserve(&set->alloc, &search->items, cell->count) &&
           array_reserve(&set->alloc, &search->chords, cell->count);
}

void chord_add(chord_search *search, const split_set *set, const split_cell *cell, uint32_t item, bool is_chord) {
    const split_fragment *f = set->items.data + cell->first + item;
    const double *p = split_image(set, f, 0), *q = split_image(set, f, split_corner_count(set, f) - 1);
    chord_item new = {.item = item, .weight = is_chord ? CHORD : OTHER};
    for (int k = 0; k < 2; k++) new.middle[k] = 0.5 * p[k] + 0.5 * q[k];
    if (is_chord) search->chords.data[search->chords.count++] = (uint32_t)search->items.count;
    search->items.data[search->items.count++] = new;
}

static bool item_is_above(const geom_plane *line, const chord_item *item) {
    return filter_value(line, item->middle).x > 0;
}

uint32_t chord_choose(chord_search *search, const split_set *set, const split_cell *cell, uint64_t seed) {
    uint64_t least = UINT64_MAX, weight[2];
    uint32_t best = 0;
    for (uint32_t round = 0; round < ROUNDS && search->chords.count; round++) {
        uint64_t draw = base_hash(seed, cell->path, 400000 + round);
        uint32_t chord = search->chords.data[base_below(draw, (uint32_t)search->chords.count)];
        /* the support of a chord */
        geom_plane line;
        scene_support(set->scene, set->items.data[cell->first + (search->items.data + chord)->item].object, &line);
        /* weights below and above a chord */
        weight[0] = weight[1] = 0;
        for (uint32_t i = 0; i < search->items.count; i++)
            if (i != chord) weight[item_is_above(&line, search->items.data + i)] += search->items.data[i].weight;
        uint64_t heavier = weight[0] > weight[1] ? weight[0] : weight[1];
        if (heavier < least) least = heavier, best = search->items.data[chord].item;
        /* leaves the candidates on one side of the chord */
        uint32_t *c = search->chords.data;
        size_t kept = 0;
        for (size_t i = 0; i < search->chords.count; i++)
            if (c[i] != chord && item_is_above(&line, search->items.data + c[i]) == (weight[1] > weight[0]))
                c[kept++] = c[i];
        search->chords.count = kept;
    }
    return best;
}
