/* overlay.c: items by sightline, and each line as a row of places between which one item is drawn. */
#include "view/picture/overlay.h"
#include "base/sort.h"
#include <math.h>

typedef ARRAY(uint32_t) overlay_ids;

/* Items that follow each other on one line. */
typedef struct overlay_line {
    double key[3];
    uint32_t line, first, end;
    bool turned;
} overlay_line;

/* An item in the direction of the current line. */
typedef struct overlay_member {
    view_end end[2];
    uint32_t place[2];
    print_point at[2];
    double near[2];
    double space[2][3];
    const view_item *item;
    uint16_t kind;
    uint8_t hidden;
} overlay_member;

/* Where ends meet. */
typedef struct overlay_place {
    print_point at;
    uint32_t vertex; /* the first of those that are seen there; FROE_NONE */
} overlay_place;

typedef struct overlayer {
    view_sightlines *sights;
    const view_drawing *drawing;
    const view_chains *chains;
    bool depths;
    ARRAY(overlay_line) lines;
    uint32_t line; /* the current one, and what is on it: */
    ARRAY(overlay_member) members;
    ARRAY(overlay_place) places;
    overlay_ids drawn, front; /* per part, from a place to the next: the member that is drawn, and the nearest */
    overlay_ids next;         /* per part: the first from it on that may still be free */
    overlay_ids order, ends, spare;
} overlayer;

/* The numbers from 0 to count - 1, sorted. */
static bool sort(overlayer *o, overlay_ids *ids, size_t count, base_compare_fn *compare) {
    const froe_allocator *alloc = &o->sights->alloc;
    ids->count = o->spare.count = 0;
    if (!array_reserve(alloc, ids, count) || !array_reserve(alloc, &o->spare, count)) return false;
    while (ids->count < count) ids->data[ids->count] = (uint32_t)ids->count, ids->count++;
    base_merge_sort(ids->data, o->spare.data, count, compare, o);
    return true;
}

/* ------------------------------------------------------------------------ lines -- */

static int by_line(void *user, uint32_t a, uint32_t b) {
    const overlayer *o = user;
    const overlay_line *x = o->lines.data + a, *y = o->lines.data + b;
    for (int k = 0; k < 3; k++)
        if (x->key[k] != y->key[k]) return x->key[k] < y->key[k] ? -1 : 1;
    return view_compare_lines(o->sights, x->line, y->line, x->key);
}

/* Adds the items of a line that equals the current one or its reverse. */
static bool add_members(overlayer *o, const view_items *items, const overlay_line *l, bool turned) {
    for (uint32_t i = l->first; i < l->end; i++) {
        const view_item *item = items->data + i;
        overlay_member m = {.item = item, .kind = item->kind, .hidden = item->hidden};
        for (int e = 0; e < 2; e++) {
            const int from = turned ? !e : e;
            view_mark mark = item->run.end[from];
            mark.way ^= turned;
            m.end[e] = view_end_at(o->sights, o->line, mark);
            m.at[e] = view_item_end(o->drawing, item, from, &m.near[e], m.space[e]);
        }
        if (!array_push(&o->sights->alloc, &o->members, m)) return false;
    }
    return true;
}

/* ----------------------------------------------------------------------- places -- */

static int by_place(void *user, uint32_t a, uint32_t b) {
    const overlayer *o = user;
    return view_compare_ends(o->sights, o->line, &o->members.data[a / 2].end[a % 2],
                             &o->members.data[b / 2].end[b % 2]);
}

/* Numbers the places where members end. A place that is a vertex lies on the page where that does. */
static bool find_places(overlayer *o) {
    o->places.count = 0;
    if (!sort(o, &o->ends, 2 * o->members.count, by_place)) return false;
    for (size_t i = 0; i < o->ends.count; i++) {
        const uint32_t end = o->ends.data[i];
        overlay_member *m = o->members.data + end / 2;
        const overlay_place here = {m->at[end % 2], m->end[end % 2].vertex};
        if (!i || by_place(o, o->ends.data[i - 1], end)) {
            if (!array_push(&o->sights->alloc, &o->places, here)) return false;
        } else if (here.vertex < o->places.data[o->places.count - 1].vertex) {
            o->places.data[o->places.count - 1] = here;
        }
        m->place[end % 2] = (uint32_t)o->places.count - 1;
    }
    return true;
}

/* --------------------------------------------------------------------- painting -- */

static int by_strength(void *user, uint32_t a, uint32_t b) {
    const overlayer *o = user;
    const overlay_member *x = o->members.data + a, *y = o->members.data + b;
    return view_strength(y->kind, y->hidden) - view_strength(x->kind, x->hidden);
}

static int by_nearness(void *user, uint32_t a, uint32_t b) {
    const overlayer *o = user;
    const overlay_member *x = o->members.data + a, *y = o->members.data + b;
    const double near_x = x->near[0] + x->near[1], near_y = y->near[0] + y->near[1];
    return x->hidden != y->hidden ? x->hidden - y->hidden : (near_x < near_y) - (near_x > near_y);
}

static uint32_t next_free(uint32_t *next, uint32_t i) {
    while (next[i] != i) {
        next[i] = next[next[i]];
        i = next[i];
    }
    return i;
}

/* Gives each member in order those of its parts that are still free. */
static bool paint_line_of_sight(overlayer *o, base_compare_fn *compare, overlay_ids *out) {
    const froe_allocator *alloc = &o->sights->alloc;
    const uint32_t n = (uint32_t)o->places.count;
    out->count = o->next.count = 0;
    if (!sort(o, &o->order, o->members.count, compare) || !array_reserve(alloc, out, n) ||
        !array_reserve(alloc, &o->next, n))
        return false;
    for (uint32_t i = 0; i < n; i++) out->data[i] = FROE_NONE, o->next.data[i] = i;
    for (size_t k = 0; k < o->order.count; k++) {
        const uint32_t m = o->order.data[k], *place = o->members.data[m].place;
        for (uint32_t i = next_free(o->next.data, place[0]); i < place[1]; i = next_free(o->next.data, i)) {
            out->data[i] = m;
            o->next.data[i] = i + 1;
        }
    }
    return true;
}

/* -------------------------------------------------------------------- segments -- */

/* Where a point of the page lies along a stretch. */
static double share_along(const print_point at[2], print_point p) {
    const double dx = at[1].x - at[0].x, dy = at[1].y - at[0].y, square = dx * dx + dy * dy;
    return square > 0 ? ((p.x - at[0].x) * dx + (p.y - at[0].y) * dy) / square : 0;
}

/* The point of space that a member has at a place of the page on its line. */
static void point_of_space(const overlayer *o, const overlay_member *m, print_point at, double out[3]) {
    const double *from = m->space[0], *to = m->space[1];
    const double t = print_share(o->drawing->view, from, to, share_along(m->at, at));
    for (int k = 0; k < 3; k++) out[k] = t == 1 ? to[k] : from[k] + t * (to[k] - from[k]);
}

static bool put_segments(overlayer *o, view_segments *out) {
    for (uint32_t i = 0, first; i + 1 < o->places.count; i++) {
        if (o->drawn.data[i] == FROE_NONE) continue;
        for (first = i; i + 2 < o->places.count; i++) { /* as long as what is drawn goes on unchanged */
            const uint32_t here = o->drawn.data[i], beyond = o->drawn.data[i + 1];
            if (beyond == FROE_NONE || (o->depths && o->front.data[i] != o->front.data[i + 1])) break;
            const overlay_member *x = o->members.data + here, *y = o->members.data + beyond;
            if (x->kind != y->kind || x->hidden != y->hidden) break;
            if (!view_runs_on(o->chains, x->kind, x->item->object, y->item->object)) break;
        }
        const overlay_member *m = o->members.data + o->drawn.data[first],
                             *nearest = o->members.data + o->front.data[first];
        view_segment s = {.object = m->item->object, .kind = m->kind, .hidden = m->hidden, .place = FROE_NONE};
        for (int e = 0; e < 2; e++) {
            const uint32_t part = e ? i : first, place = part + (uint32_t)e;
            const overlay_member *x = o->members.data + o->drawn.data[part];
            const bool own = x->place[e] == place && x->end[e].vertex != FROE_NONE; /* it ends there itself */
            s.vertex[e] = own ? x->end[e].vertex : o->places.data[place].vertex;
            s.at[e] = o->places.data[place].at;
            point_of_space(o, x, s.at[e], s.space[e]);
            /* As near as the nearest member is there, linearly along it. */
            const double t = share_along(nearest->at, s.at[e]);
            s.near[e] = nearest->near[0] + t * (nearest->near[1] - nearest->near[0]);
        }
        if (!array_push(&o->sights->alloc, out, s)) return false;
    }
    return true;
}

/* ---------------------------------------------------------------------- calling -- */

froe_status view_overlay(const view_drawing *drawing, const view_items *items, const view_chains *chains, bool depths,
                         view_segments *out) {
    view_sightlines *sights = drawing->sights;
    overlayer o = {.sights = sights, .drawing = drawing, .chains = chains, .depths = depths};
    overlay_ids lines = {0};
    if (items->count > INT32_MAX) return FROE_E_LIMIT;
    bool ok = true;
    for (uint32_t i = 0; ok && i < items->count; i++) {
        overlay_line next = {.line = items->data[i].run.line, .first = i, .end = i + 1};
        overlay_line *last = o.lines.count ? o.lines.data + o.lines.count - 1 : NULL;
        if (last && last->line == next.line)
            last->end = i + 1;
        else if (view_line_key(sights, next.line, next.key, &next.turned))
            ok = array_push(&sights->alloc, &o.lines, next);
    }
    ok = ok && sort(&o, &lines, o.lines.count, by_line);
    for (size_t i = 0, end; ok && i < lines.count; i = end) {
        for (end = i + 1; end < lines.count && !by_line(&o, lines.data[i], lines.data[end]);) end++;
        const overlay_line *first = o.lines.data + lines.data[i];
        o.line = first->line;
        o.members.count = 0;
        for (size_t k = i; ok && k < end; k++) {
            const overlay_line *l = o.lines.data + lines.data[k];
            ok = add_members(&o, items, l, l->turned != first->turned);
        }
        ok = ok && find_places(&o) && paint_line_of_sight(&o, by_strength, &o.drawn) &&
             paint_line_of_sight(&o, by_nearness, &o.front) && put_segments(&o, out);
    }
    overlay_ids *const ids[] = {&o.drawn, &o.front, &o.next, &o.order, &o.ends, &o.spare};
    for (size_t i = 0; i < sizeof ids / sizeof *ids; i++) array_free(&sights->alloc, ids[i]);
    array_free(&sights->alloc, &o.lines);
    array_free(&sights->alloc, &o.members);
    array_free(&sights->alloc, &o.places);
    array_free(&sights->alloc, &lines);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
