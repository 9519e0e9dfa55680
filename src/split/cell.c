/* cell.c: one step of the loop in grow.c. */
#include "split/cell.h"
#include "base/random.h"
#include "split/charge/thin.h"
#include <string.h>

enum { PREFETCH = 64 }; /* objects asked for at once, at most */

/** Puts the cell's covers into the list of its node, and its fragments, all or, `on`, those that lie in the cut; so
 * many. */
static froe_status emit_fragments(split_set *set, const split_cell *cell, uint32_t count, bool on) {
    froe_status status = cover_emit(set, cell);
    if (!count) return status;
    if (!status && !cell->covers) status = draft_list(set->draft, cell->node - set->draft->outer);
    for (uint32_t i = 0; i < cell->count && !status; i++)
        if (!on || set->classes.data[i] == SPLIT_ON)
            status = split_emit(set, cell->node, set->items.data + cell->first + i);
    return status;
}

froe_status cell_leaf(split_work *work, const split_cell *cell, uint8_t flags) {
    draft_leaf(work->set.draft, cell->node - work->set.draft->outer, flags);
    froe_status status = emit_fragments(&work->set, cell, cell->count, false);
    work->set.items.count = cell->first - cell->covers;
    return status;
}

typedef struct class_counts {
    uint32_t of[4]; /**< fragments per class */
} class_counts;

typedef int classify_fn(split_set *set, const split_plane *plane, const split_fragment *fragment);

/** Classifies all fragments of the cell; classes, and sides where they are found, are left in the set. */
static froe_status classify_all(split_set *set, const split_cell *cell, const split_plane *plane, classify_fn *classify,
                                class_counts *out) {
    memset(out, 0, sizeof *out);
    set->classes.count = set->sides.count = 0;
    if (!array_reserve(&set->alloc, &set->classes, cell->count)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < cell->count; i++) {
        const split_fragment *f = set->items.data + cell->first + i;
        if (!array_reserve(&set->alloc, &set->sides, split_corner_count(set, f))) return FROE_E_MEMORY;
        int class = classify(set, plane, f);
        set->classes.data[set->classes.count++] = (uint8_t) class;
        out->of[class]++;
    }
    return FROE_OK;
}

/** Of equal objects the lowest id serves as the cut: is there a lower one than the cut's? */
static bool prefer_lowest(const split_set *set, const split_cell *cell, froe_cut *cut) {
    uint32_t before = cut->id[0];
    for (uint32_t i = 0; cut->kind == FROE_CUT_OBJECT && i < cell->count; i++) {
        uint32_t object = set->items.data[cell->first + i].object;
        if (set->classes.data[i] == SPLIT_ON && object < cut->id[0] && scene_equal(set->scene, object, cut->id[0]))
            cut->id[0] = object;
    }
    return cut->id[0] != before;
}

/** Classifies by the cut, or by its lowest equal, which may face the other way. */
static froe_status classify(split_set *set, const split_cell *cell, const froe_cut *cut, split_plane *plane,
                            class_counts *out) {
    *plane = split_plane_of(set->scene, cut);
    froe_status status = classify_all(set, cell, plane, split_classify, out);
    if (status || !prefer_lowest(set, cell, &plane->cut)) return status;
    *plane = split_plane_of(set->scene, &plane->cut);
    return classify_all(set, cell, plane, split_classify, out);
}

froe_status cell_tally(split_work *work, const split_cell *cell, const froe_cut *cut, split_tally *out) {
    split_plane plane = split_plane_of(work->set.scene, cut);
    class_counts n;
    froe_status status = classify_all(&work->set, cell, &plane, split_class, &n);
    *out = (split_tally){n.of[SPLIT_NEG], n.of[SPLIT_POS], n.of[SPLIT_ON], n.of[SPLIT_BOTH]};
    return status;
}

/** Replaces the cell's fragments by those of its children: positive below, negative on top. A fragment leaves at
 * most one on the positive side, so these close up in place while the negative ones wait aside. */
static froe_status deal_fragments_of_cell(split_set *set, const split_cell *cell, const split_plane *plane,
                                          const class_counts *n) {
    if (!cell->count) { /* the arrays may not be there yet */
        set->items.count = cell->first;
        return FROE_OK;
    }
    if (set->items.count + n->of[SPLIT_BOTH] > INT32_MAX) return FROE_E_LIMIT; /* each becomes a piece at least */
    if (!array_reserve(&set->alloc, &set->items, n->of[SPLIT_BOTH])) return FROE_E_MEMORY;
    set->spare.count = 0;
    if (!array_reserve(&set->alloc, &set->spare, cell->count)) return FROE_E_MEMORY;
    split_fragment *item = set->items.data + cell->first, *pos = item, *neg = set->spare.data;
    const int8_t *sides = set->sides.data;
    for (uint32_t i = 0; i < cell->count; i++) {
        const split_fragment f = item[i];
        int class = set->classes.data[i];
        if (class == SPLIT_POS)
            *pos++ = f;
        else if (class == SPLIT_NEG)
            *neg++ = f;
        else if (class == SPLIT_BOTH && !split_is_cut(scene_form(set->scene, f.object)))
            *neg++ = *pos++ = f;
        else if (class == SPLIT_BOTH) {
            froe_status status = split_divide(set, plane, cell->node, &f, sides, neg++, pos++);
            if (status) return status;
            sides += split_corner_count(set, &f);
        }
    }
    size_t negative = (size_t)(neg - set->spare.data);
    if (negative) memcpy(pos, set->spare.data, negative * sizeof *pos);
    set->items.count = (size_t)(pos - set->items.data) + negative;
    return FROE_OK;
}

/** Does a cut that deals so with the cell's fragments keep the limits? */
static bool keep_limits(const split_cell *cell, const class_counts *n, cell_limits *limits) {
    limits->useless = !n->of[SPLIT_ON] && (!n->of[SPLIT_NEG] || !n->of[SPLIT_POS]);
    limits->kept = !limits->useless && !thin_refuses(limits->thin, cell, n->of[SPLIT_BOTH]);
    return limits->kept;
}

/** Cuts in place and makes the children; limits as for cell_cut. *listed: pieces of the node. */
static froe_status cut_in_two(split_work *work, const split_cell *parent, const froe_cut *cut, uint8_t flags,
                              cell_limits *limits, split_cell side[2], uint32_t *listed) {
    split_cell of_parent = *parent, *cell = &of_parent;
    split_set *set = &work->set;
    split_plane plane;
    class_counts n;
    uint32_t child, local = cell->node - set->draft->outer;
    froe_status status = classify(set, cell, cut, &plane, &n);
    work->tests += cell->count;
    if (status) return status;
    if (limits && !keep_limits(cell, &n, limits)) return FROE_OK;
    status = draft_split(set->draft, local, &plane.cut, flags, &child);
    if (!status) status = emit_fragments(set, cell, n.of[SPLIT_ON], true);
    cover_drop(set, cell);
    if (!status) status = deal_fragments_of_cell(set, cell, &plane, &n);
    if (status) return status;
    /* the children, with their fragments where they were left just now */
    uint32_t positive = n.of[SPLIT_POS] + n.of[SPLIT_BOTH], negative = n.of[SPLIT_NEG] + n.of[SPLIT_BOTH];
    for (uint32_t s = 0; s < 2; s++)
        side[s] = (split_cell){.node = work->set.draft->outer + child + s,
                               .depth = cell->depth + 1,
                               .path = base_path(cell->path, (int)s),
                               .first = cell->first + (s ? 0 : positive),
                               .count = s ? positive : negative,
                               .corner_top = (uint32_t)work->set.corners.count,
                               .thinned = cell->thinned,
                               .peels = cell->peels,
                               .guard = FROE_NONE};
    const size_t bytes = set->boxes ? (size_t)set->scene->dim * sizeof *cell->lo : 0;
    for (int s = 0; s < 2; s++) {
        memcpy(side[s].lo, cell->lo, bytes);
        memcpy(side[s].hi, cell->hi, bytes);
        double *bound = (s ? side[s].lo : side[s].hi) + cut->axis;
        if (bytes && cut->kind == FROE_CUT_AXIS && (s ? cut->value > *bound : cut->value < *bound)) *bound = cut->value;
    }
    *listed = parent->covers + n.of[SPLIT_ON];
    return FROE_OK;
}

/** The negative child last so that it comes first. */
static froe_status push_child_cells(split_work *work, const split_cell side[2]) {
    if (!array_reserve(&work->set.alloc, &work->cells, 2)) return FROE_E_MEMORY;
    work->cells.data[work->cells.count++] = side[1];
    work->cells.data[work->cells.count++] = side[0];
    return FROE_OK;
}

/** Tells the children the fragmentation and the barren cuts so far: see density.c. */
static void note_progress(const split_cell *parent, uint32_t listed, split_cell side[2]) {
    const uint32_t load = parent->covers + split_load(parent);
    float before = load ? (float)load : 1;
    float after = (float)split_load(&side[0]) + (float)split_load(&side[1]) + (float)listed;
    for (int s = 0; s < 2; s++) {
        bool kept = 10 * (uint64_t)split_load(&side[s]) >= 9 * (uint64_t)split_load(parent);
        side[s].growth = parent->growth * after / before;
        side[s].barren = kept ? parent->barren + 1 : 0;
        side[s].plain = parent->plain;
    }
}

froe_status cell_cut(split_work *work, const split_cell *cell, const froe_cut *cut, uint8_t flags,
                     cell_limits *limits) {
    split_cell side[2];
    uint32_t listed;
    froe_status status = cut_in_two(work, cell, cut, flags, limits, side, &listed);
    if (status || (limits && !limits->kept)) return status;
    note_progress(cell, listed, side);
    return push_child_cells(work, side);
}

froe_status cell_take(split_work *work, const split_lowest_nodes *lowest, split_cell *cell, uint32_t count) {
    split_set *set = &work->set;
    if (!array_reserve(&set->alloc, &set->items, count)) return FROE_E_MEMORY;
    if (count) {
        /* Asks for the coordinates of objects that are about to be read, all at once: without this a cell of ten
         * objects waits ten times for memory. Measured: a quarter of the time to build. */
        for (uint32_t i = 0; i < (count < PREFETCH ? count : PREFETCH); i++) {
            __builtin_prefetch(scene_point(set->scene, lowest->ids[cell->whole + i], 0));
        }
    }
    for (uint32_t i = 0; i < count; i++)
        set->items.data[set->items.count++] = (split_fragment){.object = lowest->ids[cell->whole + i]};
    cell->count += count;
    cell->whole += count;
    cell->wholes -= count;
    return FROE_OK;
}

froe_status cell_cut_guard(split_work *work, const split_job *job, split_cell *cell) {
    const split_guard_node *node = job->guard->nodes.data + cell->guard;
    froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = node->axis, .value = node->value};
    split_cell side[2];
    uint32_t listed;
    froe_status status =
        cell_take(work, job->lowest, cell, split_lowest_nodes_own(job->lowest, job->guard, cell->guard));
    if (!status) status = cover_find(&work->set, cell);
    if (!status) status = cut_in_two(work, cell, &cut, TREE_GUARD, NULL, side, &listed);
    if (status) return status;
    for (uint32_t s = 0; s < 2; s++) {
        side[s].guard = node->child + s;
        side[s].tried = cell->tried;
        side[s].whole = job->lowest->at[node->child + s];
        side[s].wholes = job->lowest->end[node->child + s] - side[s].whole;
    }
    note_progress(cell, listed, side);
    work->books.fragments += listed;
    work->books.pieces += listed;
    work->carried += listed;
    return push_child_cells(work, side);
}
