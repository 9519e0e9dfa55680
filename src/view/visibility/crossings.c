/* crossings.c: cut sides within the polygons of their cuts. */
#include "view/visibility/crossings.h"
#include "base/radix.h"
#include "base/sort.h"
#include "geom/predicates.h"
#include "tree/list.h"
#include <string.h>

/* ---------------------------------------------------------------------- finding -- */

static bool keep_open(void *user, const view_stretch *part) {
    view_crosser *c = user;
    return array_push(&c->sights->alloc, &c->open, *part);
}

/* What is seen edge-on crosses nothing, and what is culled is not there. */
static bool is_shown(const view_crosser *c, uint32_t object) {
    const int facing = view_facing(c->sights, object);
    return facing > 0 || (facing < 0 && !c->cull_back);
}

/* Appends the parts of the open stretches inside the list of a cut, or all where the cut is the section. */
static bool keep_crossed(view_crosser *c, uint32_t node, uint32_t patch, view_stretches *out) {
    view_sightlines *s = c->sights;
    const tree_objects list = tree_list(s->tree, node);
    const bool section = node == 0 && c->section;
    bool ok = true;
    for (size_t k = 0; ok && section && k < c->open.count; k++) ok = array_push(&s->alloc, out, c->open.data[k]);
    for (uint32_t k = 0; ok && !section && c->open.count && k < list.count; k++) {
        const uint32_t object = tree_object(&list, k), other = s->surface->patch_of[object];
        if (other == FROE_NONE || other == patch || !is_shown(c, object)) continue;
        ok = view_beam_of(s, list.first + k, &c->list_ring);
        for (size_t i = 0; ok && i < c->open.count; i++) { /* its part inside that piece of the list */
            view_stretch part = c->open.data[i];
            bool left = c->list_ring.count > 0; /* unless it runs along the border */
            for (size_t j = 0; left && j < c->list_ring.count; j++)
                left = view_cut_stretch(s, part.edge, c->list_ring.data[j].way, &part);
            if (left) ok = array_push(&s->alloc, out, part);
        }
    }
    return ok;
}

/* Are there polygons in the list of a cut? Segments and points may be all. */
static bool lists_polygons(const view_sightlines *s, uint32_t node) {
    const tree_objects list = tree_list(s->tree, node);
    uint32_t k = 0;
    while (k < list.count && s->surface->patch_of[tree_object(&list, k)] == FROE_NONE) k++;
    return k < list.count;
}

froe_status view_look_at_crossings(view_crosser *c, uint32_t piece, const view_ring *ring) {
    view_sightlines *s = c->sights;
    const uint32_t patch = s->surface->patch_of[s->tree->pieces[piece].object];
    for (uint32_t i = 0; i < ring->count; i++) {
        const view_line *l = s->lines.data + (ring->data[i].way >> 1);
        const uint32_t node = l->kind == VIEW_CUT ? l->b : FROE_NONE; /* whose cut makes this side */
        if (node == FROE_NONE || (!lists_polygons(s, node) && !(node == 0 && c->section))) continue;
        const view_stretch side = view_side_of_ring(ring->data, (uint32_t)ring->count, i);
        view_stretch inside = side;
        c->open.count = 0;
        if (c->hidden && view_cut_to_window(s, side.edge, &inside) &&
            (!keep_open(c, &inside) || !keep_crossed(c, node, patch, &c->all)))
            return FROE_E_MEMORY;
        c->open.count = 0; /* first the open part, as most is hidden */
        if (!view_screen_side(c->screen, ring->data[i].way, keep_open, c) || !keep_crossed(c, node, patch, &c->seen))
            return FROE_E_MEMORY;
    }
    return FROE_OK;
}

void view_crosser_free(view_crosser *c) {
    array_free(&c->sights->alloc, &c->open);
    array_free(&c->sights->alloc, &c->seen);
    array_free(&c->sights->alloc, &c->all);
    array_free(&c->sights->alloc, &c->list_ring);
}

/* ----------------------------------------------------------------------- keeping -- */

typedef struct crossing_line {
    uint32_t line, patch;
    bool section, hidden;
} crossing_line;

/* A stretch in its final form. */
static bool put_crossing(froe_visibility *v, const view_end *from, const view_end *to, crossing_line on) {
    const view_sightlines *s = &v->sights;
    froe_crossing x = {.patch = on.patch, .section = on.section, .hidden = on.hidden};
    const view_run run = {on.line, {view_mark_of(from), view_mark_of(to)}};
    const geom_plane plane = view_plane_of(s, x.patch),
                     cut = view_plane_of_cut(s, x.section ? 0 : s->lines.data[on.line].b);
    view_point_on_both(s, &plane, &cut, from->ray.x, x.from);
    view_point_on_both(s, &plane, &cut, to->ray.x, x.to);
    return array_push(&v->alloc, &v->crossings, x) && array_push(&v->alloc, &v->crossing_runs, run);
}

/* The line of a stretch that was found on a cut side. */
static crossing_line line_of_crossing(const froe_visibility *v, uint32_t line, bool hidden) {
    const view_line *l = v->sights.lines.data + line;
    return (crossing_line){line, l->a, v->section && l->b == 0, hidden};
}

/* -------------------------------------------------------------- along the section -- */

froe_status view_look_along_section(froe_visibility *v, uint32_t object) {
    view_sightlines *s = &v->sights;
    const uint32_t *edges = s->surface->edge_of + scene_start(s->tree->scene, object);
    const froe_scene *scene = s->tree->scene;
    const geom_plane plane = tree_plane_at(s->tree, 0);
    const uint32_t n = scene_corners(scene, object);
    view_mark mark[2];
    while (view_is_point(s, *edges)) edges++; /* all that are seen as lines lie on one */
    const uint32_t line = view_line_of_edge(s, *edges);
    if (line == FROE_NONE) return FROE_E_MEMORY;
    /* The two points of its border in which the section parts the polygon. */
    int count = 0, reached = 0, last = geom_side_vertex(&s->context, &plane, scene_point(scene, object, n - 1));
    for (uint32_t i = 0; i < n; i++) {
        const int side = geom_side_vertex(&s->context, &plane, scene_point(scene, object, i));
        const uint32_t before = s->surface->edge_of[scene_start(scene, object) + (i ? i - 1 : n - 1)];
        reached |= side > 0 ? 2 : side < 0 ? 1 : 0;
        if (!side && count < 2) /* there are more where it touches the polygon along a side */
            mark[count++] = (view_mark){.vertex = scene_corner(scene, object, i)};
        if (side * last < 0 && view_stop_edge(s, before, FROE_NONE, line, &mark[count++])) return FROE_E_MEMORY;
        last = side;
    }
    if (reached != 3) return FROE_OK; /* the section only touches it */
    view_stretch part = {line, {view_end_at(s, line, mark[0]), view_end_at(s, line, mark[1])}};
    if (view_compare_ends(s, line, &part.end[0], &part.end[1]) > 0)
        part = (view_stretch){line, {part.end[1], part.end[0]}};
    if (!view_cut_to_window(s, line, &part)) return FROE_OK;
    return put_crossing(v, &part.end[0], &part.end[1], (crossing_line){line, s->surface->patch_of[object], true, false})
               ? FROE_OK
               : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------ between patches -- */

/* Where a third cut runs along the line in which two patches cross, it divides both, and neither lies in its list. Then
 * the sides that it makes of both lie on one line of space, and cross where they overlap. */
typedef struct cut_line {
    double key[3];
    uint32_t line;  /* of a patch and a node; 0: this entry is none */
    uint32_t first; /* of the lines that are one with it */
    uint32_t plane; /* of its patch, among those of these lines */
} cut_line;

typedef struct between_patches {
    froe_visibility *v;
    ARRAY(cut_line) lines; /* by node, equal ones together */
    size_t count;          /* of lines */
    uint32_t *mate_of;     /* per line: 1 + its place in `lines`, if others cross on it; before, 1 for all that count */
    view_stretches sides;  /* each on the first of the equal lines */
    ARRAY(uint32_t) planes; /* of the sides */
    view_ring ring;
} between_patches;

static bool is_cut_between(const between_patches *b, uint32_t line) {
    const view_line *l = b->v->sights.lines.data + line;
    return l->kind == VIEW_CUT && (l->b || !b->v->section);
}

/* Are two patches, which a cut divides along one line, in one plane? */
static bool share_a_plane(view_sightlines *s, uint32_t a, uint32_t b) {
    geom_plane plane, other;
    bool same = true;
    scene_support(s->tree->scene, surface_first(s->surface, a), &plane);
    scene_support(s->tree->scene, surface_first(s->surface, b), &other);
    for (int k = 0; k < 3 && same; k++) same = geom_side_vertex(&s->context, &plane, other.p[k]) == 0;
    return same;
}

static int by_cut_line(void *user, uint32_t a, uint32_t b) {
    const between_patches *t = user;
    view_sightlines *s = &t->v->sights;
    const cut_line *x = t->lines.data + a, *y = t->lines.data + b;
    const uint32_t at = s->lines.data[x->line].b, of = s->lines.data[y->line].b;
    if (at != of) return at < of ? -1 : 1;
    for (int k = 0; k < 3; k++)
        if (x->key[k] != y->key[k]) return x->key[k] < y->key[k] ? -1 : 1;
    return view_compare_cuts(s, x->line, y->line, x->key);
}

/* Numbers the planes of equal lines, items[0 .. count), and keeps these if there are several. */
static void keep_mates(between_patches *b, const uint32_t *items, size_t count) {
    view_sightlines *s = &b->v->sights;
    uint32_t planes = 0;
    for (size_t i = 0; i < count; i++) {
        cut_line *x = b->lines.data + items[i];
        x->first = b->lines.data[items[0]].line;
        x->plane = planes;
        for (size_t j = 0; j < i && x->plane == planes; j++) {
            const cut_line *y = b->lines.data + items[j];
            if (share_a_plane(s, s->lines.data[y->line].a, s->lines.data[x->line].a)) x->plane = y->plane;
        }
        planes += x->plane == planes;
    }
    for (size_t i = 0; i < count; i++) b->mate_of[b->lines.data[items[i]].line] = planes > 1 ? items[i] + 1 : 0;
}

/* Of the lines that `mate_of` names, keeps those on which patches of several planes meet. *any: there are some. */
static froe_status find_mates(between_patches *b, bool *any) {
    view_sightlines *s = &b->v->sights;
    const size_t count = s->lines.count;
    base_pair *pairs = support_calloc(&s->alloc, 2 * count + 1, sizeof *pairs);
    uint32_t *items = NULL;
    size_t n = 0;
    bool ok = pairs != NULL;
    *any = false;
    for (uint32_t i = 0; ok && i < count; i++)
        if (b->mate_of[i]) pairs[n++] = (base_pair){s->lines.data[i].b, i}, b->mate_of[i] = 0;
    if (ok) base_radix_sort(pairs, pairs + n, n);
    for (size_t i = 0; ok && i < n; i++) { /* a node that divides one patch alone has no such lines */
        if ((!i || pairs[i - 1].key != pairs[i].key) && (i + 1 == n || pairs[i + 1].key != pairs[i].key)) continue;
        cut_line x = {.line = pairs[i].value};
        view_cut_key(s, x.line, x.key);
        ok = array_push(&s->alloc, &b->lines, x);
    }
    const size_t m = b->lines.count;
    ok = ok && (items = support_calloc(&s->alloc, 2 * m + 1, sizeof *items)) != NULL;
    for (uint32_t i = 0; ok && i < m; i++) items[i] = i;
    if (ok) base_merge_sort(items, items + m, m, by_cut_line, b);
    for (size_t i = 0, j; ok && i < m; i = j) {
        for (j = i + 1; j < m && !by_cut_line(b, items[i], items[j]);) j++;
        if (j > i + 1) keep_mates(b, items + i, j - i);
        *any = *any || b->mate_of[b->lines.data[items[i]].line];
    }
    support_free(&s->alloc, items, (2 * m + 1) * sizeof *items);
    support_free(&s->alloc, pairs, (2 * count + 1) * sizeof *pairs);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* Appends the sides of a ring that lie on such lines. */
static bool put_sides(between_patches *b, uint32_t patch, bool clip) {
    view_sightlines *s = &b->v->sights;
    for (uint32_t i = 0; i < b->ring.count; i++) {
        const uint32_t line = b->ring.data[i].way >> 1, mate = line < b->count ? b->mate_of[line] : 0;
        if (!mate || s->lines.data[line].a != patch) continue;
        const uint32_t first = b->lines.data[mate - 1].first;
        view_stretch side = view_side_of_ring(b->ring.data, (uint32_t)b->ring.count, i);
        if (clip && !view_cut_to_window(s, line, &side)) continue;
        const double *x = s->lines.data[line].image.x, *y = s->lines.data[first].image.x;
        side.edge = first;
        if (x[0] * y[0] + x[1] * y[1] + x[2] * y[2] < 0) { /* the first one has the opposite direction */
            const view_end from = side.end[0];
            side.end[0] = side.end[1], side.end[1] = from;
            side.end[0].way ^= 1, side.end[1].way ^= 1;
        }
        if (!array_push(&s->alloc, &b->sides, side) ||
            !array_push(&s->alloc, &b->planes, b->lines.data[mate - 1].plane))
            return false;
    }
    return true;
}

static int by_side(void *user, uint32_t a, uint32_t b) {
    const between_patches *t = user;
    const view_stretch *x = t->sides.data + a, *y = t->sides.data + b;
    if (x->edge != y->edge) return x->edge < y->edge ? -1 : 1;
    return view_compare_along(&t->v->sights, x->edge, &x->end[0], &y->end[0]);
}

/* Appends where sides of patches in different planes overlap. Each is compared only with the one that ends last of
 * those that begin before it on its line. That one covers wherever the side overlaps others: either it is in another
 * plane than the side, or it is in the same, and then where it overlaps those others has been appended. */
static froe_status put_overlaps(between_patches *b, view_stretches *out) {
    view_sightlines *s = &b->v->sights;
    const size_t n = b->sides.count;
    if (n > INT32_MAX) return FROE_E_LIMIT;
    uint32_t *items = support_calloc(&s->alloc, 2 * n + 1, sizeof *items), far = 0;
    bool ok = items != NULL;
    for (uint32_t i = 0; ok && i < n; i++) items[i] = i;
    if (ok) base_merge_sort(items, items + n, n, by_side, b);
    for (size_t i = 0; ok && i < n; i++) {
        const view_stretch *x = b->sides.data + far, *y = b->sides.data + items[i];
        const bool first = !i || x->edge != y->edge;
        const bool within = !first && view_compare_along(s, x->edge, &y->end[1], &x->end[1]) < 0;
        if (!first && b->planes.data[far] != b->planes.data[items[i]] &&
            view_compare_along(s, x->edge, &y->end[0], &x->end[1]) < 0) {
            const view_stretch part = {x->edge, {y->end[0], within ? y->end[1] : x->end[1]}};
            ok = array_push(&s->alloc, out, part);
        }
        if (!within) far = items[i];
    }
    support_free(&s->alloc, items, (2 * n + 1) * sizeof *items);
    b->sides.count = b->planes.count = 0;
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* The sides of all pieces, visible or not. */
static bool put_all_sides(between_patches *b, const view_crosser *c) {
    view_sightlines *s = &b->v->sights;
    const froe_tree *t = s->tree;
    const int section = b->v->section;
    const uint32_t middle = section ? tree_first_piece(t, t->nodes->child + 1) : 0;
    const uint32_t from = section > 0 ? middle : section ? tree_first_piece(t, t->nodes->child) : 0;
    bool ok = true;
    for (uint32_t i = from; ok && i < (section < 0 ? middle : t->piece_count); i++) {
        const uint32_t object = t->pieces[i].object, patch = s->surface->patch_of[object];
        if (patch == FROE_NONE || !is_shown(c, object)) continue;
        ok = view_beam_of(s, i, &b->ring) && put_sides(b, patch, true);
    }
    return ok;
}

froe_status view_look_between_patches(froe_visibility *v, view_crosser *c) {
    view_sightlines *s = &v->sights;
    const size_t count = s->lines.count;
    between_patches b = {.v = v, .count = count, .mate_of = support_calloc(&s->alloc, count + 1, sizeof *b.mate_of)};
    bool any = false;
    froe_status status = b.mate_of ? FROE_OK : FROE_E_MEMORY;
    for (uint32_t i = 0; !status && c->hidden && i < count; i++) b.mate_of[i] = is_cut_between(&b, i);
    for (uint32_t i = 0; !status && i < v->piece_count; i++)
        for (uint32_t k = 0; k < v->pieces[i].count; k++) {
            const uint32_t line = v->corners.data[v->pieces[i].first + k].way >> 1;
            if (is_cut_between(&b, line) && s->lines.data[line].a == v->pieces[i].patch) b.mate_of[line] = 1;
        }
    if (!status) status = find_mates(&b, &any);
    for (uint32_t i = 0; !status && any && i < v->piece_count; i++)
        if (!view_ring_of_visible(v, s, i, &b.ring) || !put_sides(&b, v->pieces[i].patch, false))
            status = FROE_E_MEMORY;
    if (!status) status = put_overlaps(&b, &c->seen);
    if (!status && any && c->hidden && !put_all_sides(&b, c)) status = FROE_E_MEMORY;
    if (!status) status = put_overlaps(&b, &c->all);
    support_free(&s->alloc, b.mate_of, (count + 1) * sizeof *b.mate_of);
    array_free(&s->alloc, &b.lines);
    array_free(&s->alloc, &b.sides);
    array_free(&s->alloc, &b.planes);
    array_free(&s->alloc, &b.ring);
    return status;
}

/* ---------------------------------------------------------------------- joining -- */

typedef struct stretch_joiner {
    view_sightlines *sights;
    const view_stretch *stretches;
} stretch_joiner;

static int by_line(void *user, uint32_t a, uint32_t b) {
    const stretch_joiner *j = user;
    const view_stretch *x = j->stretches + a, *y = j->stretches + b;
    if (x->edge != y->edge) return x->edge < y->edge ? -1 : 1;
    return view_compare_along(j->sights, x->edge, &x->end[0], &y->end[0]);
}

/* Sorts the stretches of each line and unites those that touch or overlap. */
static froe_status join_stretches(view_sightlines *s, view_stretches *stretches) {
    const size_t n = stretches->count;
    if (n > INT32_MAX) return FROE_E_LIMIT;
    uint32_t *items = support_calloc(&s->alloc, 2 * n + 1, sizeof *items);
    view_stretch *copy = support_calloc(&s->alloc, n + 1, sizeof *copy);
    if (items && copy) {
        stretch_joiner j = {s, copy};
        if (n) memcpy(copy, stretches->data, n * sizeof *copy);
        for (uint32_t i = 0; i < n; i++) items[i] = i;
        base_merge_sort(items, items + n, n, by_line, &j);
        size_t kept = 0; /* what is left is in order and disjoint */
        for (size_t i = 0; i < n; i++) {
            const view_stretch next = copy[items[i]];
            view_stretch *last = kept ? stretches->data + kept - 1 : NULL;
            if (!last || last->edge != next.edge || view_compare_along(s, next.edge, &next.end[0], &last->end[1]) > 0)
                stretches->data[kept++] = next;
            else if (view_compare_along(s, next.edge, &next.end[1], &last->end[1]) > 0)
                last->end[1] = next.end[1];
        }
        stretches->count = kept;
    }
    const bool ok = items && copy;
    support_free(&s->alloc, items, (2 * n + 1) * sizeof *items);
    support_free(&s->alloc, copy, (n + 1) * sizeof *copy);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* Appends the hidden parts of a stretch, between visible ones from *seen on and before `end`. *seen moves on. */
static bool put_hidden(froe_visibility *v, const view_stretch *part, const view_stretch **seen,
                       const view_stretch *end) {
    view_sightlines *s = &v->sights;
    const uint32_t line = part->edge;
    const view_end *from = &part->end[0], *to = &part->end[1];
    while (*seen < end && (*seen)->edge < line) ++*seen;
    for (const view_stretch *x = *seen; x < end && x->edge == line; x++) {
        if (view_compare_along(s, line, &x->end[1], from) <= 0) continue;
        if (view_compare_along(s, line, &x->end[0], to) >= 0) break;
        if (view_compare_along(s, line, from, &x->end[0]) < 0 &&
            !put_crossing(v, from, &x->end[0], line_of_crossing(v, line, true)))
            return false;
        from = &x->end[1];
    }
    return view_compare_along(s, line, from, to) >= 0 || put_crossing(v, from, to, line_of_crossing(v, line, true));
}

froe_status view_join_crossings(froe_visibility *v, view_crosser *c) {
    froe_status status = join_stretches(&v->sights, &c->seen);
    if (!status) status = join_stretches(&v->sights, &c->all);
    bool ok = !status;
    for (size_t i = 0; ok && i < c->seen.count; i++) {
        const view_stretch *x = c->seen.data + i;
        ok = put_crossing(v, &x->end[0], &x->end[1], line_of_crossing(v, x->edge, false));
    }
    const view_stretch *seen = c->seen.data;
    for (size_t i = 0; ok && i < c->all.count; i++)
        ok = put_hidden(v, c->all.data + i, &seen, c->seen.data + c->seen.count);
    return status ? status : ok ? FROE_OK : FROE_E_MEMORY;
}
