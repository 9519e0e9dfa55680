/* crossings.c: cut sides within the polygons of their cuts. */
#include "view/crossings.h"
#include "base/sort.h"
#include <string.h>

/* ---------------------------------------------------------------------- finding -- */

/* The side that leaves corner i of a beam, along its line: see side_of() in region.c. */
static view_stretch stretch_of(const view_ring *ring, uint32_t i) {
    const uint32_t count = (uint32_t)ring->count, j = i + 1 < count ? i + 1 : 0;
    const view_corner *k = ring->data + i, *next = ring->data + j;
    const view_way before = ring->data[i ? i - 1 : count - 1].way;
    const uint32_t turned = k->way & 1;
    view_stretch s = {.edge = k->way >> 1};
    s.end[turned] = (view_end){k->ray, k->vertex, before ^ 1 ^ turned};
    s.end[!turned] = (view_end){next->ray, next->vertex, next->way ^ turned};
    return s;
}

static int side_of_end(view_sights *s, uint32_t line, const view_end *end, uint32_t own) {
    return view_side(s, line, &end->ray, end->vertex, 2 * own, end->way);
}

/* Cuts a stretch to the inside of a beam; false when nothing is left, or it runs along the border. */
static bool cut_to_beam(view_sights *s, const view_ring *beam, view_stretch *part) {
    const uint32_t own = part->edge;
    for (size_t i = 0; i < beam->count; i++) {
        const uint32_t line = beam->data[i].way >> 1;
        const int turn = beam->data[i].way & 1 ? -1 : 1, from = side_of_end(s, line, &part->end[0], own),
                  to = side_of_end(s, line, &part->end[1], own);
        if (turn * from <= 0 && turn * to <= 0) return false;
        if (from * to >= 0) continue;
        view_end middle = {.vertex = FROE_NONE, .way = 2 * line + (from < 0)};
        middle.ray = view_meeting(s, 2 * own, middle.way);
        part->end[turn * from > 0] = middle; /* the end outside moves in */
    }
    return true;
}

/* The node whose cut makes side `way` of a piece; FROE_NONE: no cut does. */
static uint32_t node_of(const view_sights *s, view_way way) {
    const view_line *l = s->lines.data + (way >> 1);
    return l->kind == VIEW_CUT ? l->b : FROE_NONE;
}

static bool keep_open(void *user, const view_stretch *part) {
    view_crosser *c = user;
    return array_push(&c->sights->alloc, &c->open, *part);
}

/* What of the open stretches lies inside a piece of the list. */
static bool keep_inside(view_crosser *c, uint32_t piece, view_stretches *out) {
    if (!view_beam_of(c->sights, piece, &c->list_ring)) return false;
    for (size_t i = 0; i < c->open.count; i++) {
        view_stretch part = c->open.data[i];
        if (cut_to_beam(c->sights, &c->list_ring, &part) && !array_push(&c->sights->alloc, out, part)) return false;
    }
    return true;
}

/* What of the open stretches lies inside the list of a cut, or all where that is the section. */
static bool keep_crossed(view_crosser *c, uint32_t node, uint32_t patch, view_stretches *out) {
    view_sights *s = c->sights;
    const tree_objects list = tree_list(s->tree, node);
    const bool section = node == 0 && c->section;
    bool ok = true;
    for (size_t k = 0; ok && section && k < c->open.count; k++) ok = array_push(&s->alloc, out, c->open.data[k]);
    for (uint32_t k = 0; ok && !section && c->open.count && k < list.count; k++) {
        const uint32_t object = tree_object(&list, k), other = s->surface->patch_of[object];
        if (other != FROE_NONE && other != patch && view_facing(s, object)) ok = keep_inside(c, list.first + k, out);
    }
    return ok;
}

froe_status view_look_at_crossings(view_crosser *c, uint32_t piece, const view_ring *ring) {
    view_sights *s = c->sights;
    const uint32_t patch = s->surface->patch_of[s->tree->pieces[piece].object];
    for (uint32_t i = 0; i < ring->count; i++) {
        const uint32_t node = node_of(s, ring->data[i].way);
        if (node == FROE_NONE || (!tree_list(s->tree, node).count && !(node == 0 && c->section))) continue;
        const view_stretch side = stretch_of(ring, i);
        c->open.count = 0;
        if (c->hidden && (!keep_open(c, &side) || !keep_crossed(c, node, patch, &c->all))) return FROE_E_MEMORY;
        c->open.count = 0; /* first what is open: most is hidden */
        const froe_status status =
            view_screen_classify(c->screen, &side, side.edge, ring->data, (uint32_t)ring->count, keep_open, c);
        if (status) return status;
        if (!keep_crossed(c, node, patch, &c->seen)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

void view_crosser_free(view_crosser *c) {
    array_free(&c->sights->alloc, &c->open);
    array_free(&c->sights->alloc, &c->seen);
    array_free(&c->sights->alloc, &c->all);
    array_free(&c->sights->alloc, &c->list_ring);
}

froe_status view_look_along_section(froe_visibility *v, uint32_t piece, uint32_t patch) {
    const uint32_t root = froe_tree_root(v->tree).id1, n = froe_tree_piece(v->tree, piece).corners;
    double *x = base_calloc(&v->alloc, 3 * (size_t)n + 1, sizeof *x);
    froe_node *made = base_calloc(&v->alloc, (size_t)n + 1, sizeof *made);
    bool ok = x && made;
    if (ok) froe_tree_piece_corners(v->tree, piece, x, made, n);
    for (uint32_t i = 0; ok && i < n; i++) {
        froe_crossing line = {.patch = patch, .section = true};
        if (made[i].id1 != root) continue;
        memcpy(line.from, x + 3 * (size_t)i, sizeof line.from);
        memcpy(line.to, x + 3 * (size_t)(i + 1 < n ? i + 1 : 0), sizeof line.to);
        ok = array_push(&v->alloc, &v->crossings, line);
    }
    base_free(&v->alloc, x, (3 * (size_t)n + 1) * sizeof *x);
    base_free(&v->alloc, made, ((size_t)n + 1) * sizeof *made);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* ---------------------------------------------------------------------- joining -- */

typedef struct joiner {
    view_sights *sights;
    const view_stretch *stretches;
} joiner;

static int by_line(void *user, uint32_t a, uint32_t b) {
    const joiner *j = user;
    const view_stretch *x = j->stretches + a, *y = j->stretches + b;
    if (x->edge != y->edge) return x->edge < y->edge ? -1 : 1;
    return view_compare_along(j->sights, x->edge, &x->end[0], &y->end[0]);
}

/* Unites the stretches of each line; what is left is in order and disjoint. */
static void unite(view_sights *s, const uint32_t *items, const view_stretch *stretches, view_stretches *out) {
    for (size_t i = 0; i < out->count; i++) out->data[i] = stretches[items[i]];
    size_t kept = 0;
    for (size_t i = 0; i < out->count; i++) {
        const view_stretch next = out->data[i];
        view_stretch *last = kept ? out->data + kept - 1 : NULL;
        if (!last || last->edge != next.edge || view_compare_along(s, next.edge, &next.end[0], &last->end[1]) > 0)
            out->data[kept++] = next;
        else if (view_compare_along(s, next.edge, &next.end[1], &last->end[1]) > 0)
            last->end[1] = next.end[1];
    }
    out->count = kept;
}

static froe_status join(view_sights *s, view_stretches *stretches) {
    const size_t n = stretches->count;
    if (n > INT32_MAX) return FROE_E_LIMIT;
    uint32_t *items = base_calloc(&s->alloc, 2 * n + 1, sizeof *items);
    view_stretch *copy = base_calloc(&s->alloc, n + 1, sizeof *copy);
    if (items && copy) {
        joiner j = {s, copy};
        if (n) memcpy(copy, stretches->data, n * sizeof *copy);
        for (uint32_t i = 0; i < n; i++) items[i] = i;
        base_merge_sort(items, items + n, n, by_line, &j);
        unite(s, items, copy, stretches);
    }
    const bool ok = items && copy;
    base_free(&s->alloc, items, (2 * n + 1) * sizeof *items);
    base_free(&s->alloc, copy, (n + 1) * sizeof *copy);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

static bool put_crossing(froe_visibility *v, uint32_t line, const view_end *from, const view_end *to, bool hidden) {
    const view_line *l = v->sights.lines.data + line;
    froe_crossing x = {.patch = l->a, .section = v->section && l->b == 0, .hidden = hidden};
    const geom_plane plane = view_plane_of(&v->sights, x.patch);
    view_point_on(&v->sights, &plane, from->ray.x, x.from);
    view_point_on(&v->sights, &plane, to->ray.x, x.to);
    return array_push(&v->alloc, &v->crossings, x);
}

/* What lies between the visible stretches *seen and before `end` in their array; *seen moves on. */
static bool put_hidden(froe_visibility *v, const view_stretch *part, const view_stretch **seen,
                       const view_stretch *end) {
    view_sights *s = &v->sights;
    const uint32_t line = part->edge;
    const view_end *from = &part->end[0], *to = &part->end[1];
    while (*seen < end && (*seen)->edge < line) ++*seen;
    for (const view_stretch *x = *seen; x < end && x->edge == line; x++) {
        if (view_compare_along(s, line, &x->end[1], from) <= 0) continue;
        if (view_compare_along(s, line, &x->end[0], to) >= 0) break;
        if (view_compare_along(s, line, from, &x->end[0]) < 0 && !put_crossing(v, line, from, &x->end[0], true))
            return false;
        from = &x->end[1];
    }
    return view_compare_along(s, line, from, to) >= 0 || put_crossing(v, line, from, to, true);
}

froe_status view_join_crossings(froe_visibility *v, view_crosser *c) {
    froe_status status = join(&v->sights, &c->seen);
    if (!status) status = join(&v->sights, &c->all);
    bool ok = !status;
    for (size_t i = 0; ok && i < c->seen.count; i++) {
        const view_stretch *x = c->seen.data + i;
        ok = put_crossing(v, x->edge, &x->end[0], &x->end[1], false);
    }
    const view_stretch *seen = c->seen.data;
    for (size_t i = 0; ok && i < c->all.count; i++)
        ok = put_hidden(v, c->all.data + i, &seen, c->seen.data + c->seen.count);
    return status ? status : ok ? FROE_OK : FROE_E_MEMORY;
}
