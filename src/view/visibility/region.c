/* region.c: sides cancel along lines, and the rest is chained to rings.
 *
 * A corner of a piece stands for its point; corners that are the same point of a line are united. Around any point the
 * pieces of a region meet along lines, so that the ends of borders which belong together become one. */
#include "view/visibility/region.h"
#include "base/floats.h"
#include "base/sort.h"
#include "support/fail.h"

typedef struct region_maker {
    view_region *r;
    const froe_visibility *v;
    view_sightlines *sights;
    const froe_allocator *alloc;
} region_maker;

/* ------------------------------------------------------------------------ points -- */

static uint32_t find_point_root(uint32_t *point, uint32_t i) {
    while (point[i] != i) i = point[i] = point[point[i]];
    return i;
}

/* ------------------------------------------------------------------------- sides -- */

/* The side that leaves corner i of a piece. A corner is  before x way, and also  way x after  of the side before. */
static region_side side_of_ring(const view_spot *ring, uint32_t count, uint32_t i, uint32_t number) {
    const uint32_t j = i + 1 < count ? i + 1 : 0;
    const view_way way = ring[i].way, before = ring[i ? i - 1 : count - 1].way, after = ring[j].way;
    const uint32_t turned = way & 1;
    region_side s = {.line = way >> 1, .turned = turned};
    s.end[turned] = number + i;
    s.end[!turned] = number + j;
    s.across[turned] = before ^ 1 ^ turned; /* before x way = line x -before, or with the line turned: line x before */
    s.across[!turned] = after ^ turned;
    return s;
}

static bool list_sides(region_maker *m, uint32_t patch) {
    const froe_visibility *v = m->v;
    view_region *r = m->r;
    size_t total = 0;
    for (uint32_t p = v->patch_starts[patch]; p < v->patch_starts[patch + 1]; p++) total += v->pieces[p].count;
    r->sides.count = r->point.count = r->first_border.count = r->corner_of.count = 0;
    if (!array_reserve(m->alloc, &r->sides, total) || !array_reserve(m->alloc, &r->point, total) ||
        !array_reserve(m->alloc, &r->first_border, total) || !array_reserve(m->alloc, &r->by_line, 2 * total) ||
        !array_reserve(m->alloc, &r->corner_of, total))
        return false;
    for (uint32_t p = v->patch_starts[patch]; p < v->patch_starts[patch + 1]; p++) {
        const view_piece *piece = v->pieces + p;
        const uint32_t number = (uint32_t)r->sides.count;
        for (uint32_t i = 0; i < piece->count; i++) {
            const uint32_t n = number + i;
            r->sides.data[r->sides.count++] = side_of_ring(v->corners.data + piece->first, piece->count, i, number);
            r->corner_of.data[r->corner_of.count++] = view_turn_at(v, piece, i);
            r->point.data[r->point.count++] = n;
            r->first_border.data[r->first_border.count++] = FROE_NONE;
            r->by_line.data[n] = (base_pair){r->sides.data[n].line, n};
        }
    }
    base_radix_sort(r->by_line.data, r->by_line.data + total, total);
    return true;
}

/* ------------------------------------------------------------------ along a line -- */

static int compare_ends(void *user, uint32_t a, uint32_t b) {
    region_maker *m = user;
    const region_side *s = m->r->sides.data + (a >> 1), *t = m->r->sides.data + (b >> 1);
    const uint32_t p = s->end[a & 1], q = t->end[b & 1];
    if (find_point_root(m->r->point.data, p) == find_point_root(m->r->point.data, q)) return 0;
    const view_spot *x = m->v->corners.data + m->r->corner_of.data[p].corner;
    const view_spot *y = m->v->corners.data + m->r->corner_of.data[q].corner;
    const uint32_t vertex = view_vertex_of(x);
    if (vertex != FROE_NONE && vertex == y->vertex) return 0;
    const view_way n = t->across[b & 1];
    const view_end end = view_end_at(m->sights, s->line, (view_mark){vertex, s->across[a & 1]});
    const int side = view_side(m->sights, n >> 1, &end.ray, vertex, 2 * s->line, s->across[a & 1]);
    return n & 1 ? side : -side;
}

/* Sorted ends of all sides on a line: between two points there is border where pieces are on one side only. */
static bool sweep(region_maker *m, const uint32_t *ends, uint32_t count) {
    int active[2] = {0, 0}, state = 0;
    uint32_t since = 0;
    for (uint32_t i = 0; i < count;) {
        const uint32_t here = m->r->sides.data[ends[i] >> 1].end[ends[i] & 1];
        uint32_t j = i;
        for (; j < count && (j == i || compare_ends(m, ends[j - 1], ends[j]) == 0); j++) {
            const region_side *s = m->r->sides.data + (ends[j] >> 1);
            uint32_t *point = m->r->point.data;
            const uint32_t a = find_point_root(point, here), b = find_point_root(point, s->end[ends[j] & 1]);
            point[a > b ? a : b] = a > b ? b : a;
            active[s->turned] += ends[j] & 1 ? -1 : 1;
        }
        i = j;
        const int now = (active[0] > 0) - (active[1] > 0);
        if (now == state) continue;
        const region_border border = {state > 0 ? since : here, state > 0 ? here : since, FROE_NONE};
        if (state && !array_push(m->alloc, &m->r->borders, border)) return false;
        state = now;
        since = here;
    }
    return true;
}

static bool sweep_lines(region_maker *m) {
    view_region *r = m->r;
    const uint32_t total = (uint32_t)r->sides.count;
    r->borders.count = 0;
    for (uint32_t i = 0; i < total;) {
        uint32_t j = i, count = 0;
        while (j < total && r->by_line.data[j].key == r->by_line.data[i].key) j++;
        r->ends.count = 0;
        if (!array_reserve(m->alloc, &r->ends, 4 * (size_t)(j - i))) return false;
        for (uint32_t k = i; k < j; k++)
            for (uint32_t e = 0; e < 2; e++) r->ends.data[count++] = 2 * r->by_line.data[k].value + e;
        base_merge_sort(r->ends.data, r->ends.data + count, count, compare_ends, m);
        if (!sweep(m, r->ends.data, count)) return false;
        i = j;
    }
    return true;
}

/* ------------------------------------------------------------------------- rings -- */

static uint32_t take_border(region_maker *m, uint32_t corner) {
    uint32_t *first = m->r->first_border.data + find_point_root(m->r->point.data, corner), border = *first;
    if (border != FROE_NONE) *first = m->r->borders.data[border].next;
    return border;
}

froe_status view_region_make(view_region *region, const froe_visibility *v, view_sightlines *sights, uint32_t patch) {
    region_maker m = {region, v, sights, &v->alloc};
    if (!list_sides(&m, patch) || !sweep_lines(&m)) return FROE_E_MEMORY;
    /* Chains borders to rings. */
    for (uint32_t b = 0; b < region->borders.count; b++) {
        uint32_t *first = region->first_border.data + find_point_root(region->point.data, region->borders.data[b].from);
        region->borders.data[b].next = *first;
        *first = b;
    }
    region->corners.count = region->starts.count = 0;
    if (!array_reserve(m.alloc, &region->corners, region->borders.count) ||
        !array_reserve(m.alloc, &region->starts, region->borders.count + 1))
        return FROE_E_MEMORY;
    for (uint32_t b = 0; b < region->borders.count; b++) {
        uint32_t border = take_border(&m, region->borders.data[b].from);
        if (border == FROE_NONE) continue;
        region->starts.data[region->starts.count++] = (uint32_t)region->corners.count;
        for (; border != FROE_NONE; border = take_border(&m, region->borders.data[border].to))
            region->corners.data[region->corners.count++] = region->corner_of.data[region->borders.data[border].from];
    }
    region->starts.data[region->starts.count++] = (uint32_t)region->corners.count;
    return FROE_OK;
}

void view_region_free(const froe_allocator *alloc, view_region *r) {
    array_free(alloc, &r->corners);
    array_free(alloc, &r->starts);
    array_free(alloc, &r->corner_of);
    array_free(alloc, &r->sides);
    array_free(alloc, &r->by_line);
    array_free(alloc, &r->ends);
    array_free(alloc, &r->point);
    array_free(alloc, &r->borders);
    array_free(alloc, &r->first_border);
}

/* ---------------------------------------------------------------------- calling -- */

typedef struct region_rings {
    view_region region;
    ARRAY(double) coords;
    ARRAY(size_t) starts;
} region_rings;

froe_status froe_visibility_regions(const froe_visibility *v, uint32_t first, uint32_t count, froe_region_fn *fn,
                                    void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    region_rings g = {.coords = {0}};
    bool go_on = true;
    if (!v || !fn) return support_fail_null(diag, __func__);
    view_sightlines sights;
    if (view_sightlines_fork(&v->sights, &sights)) return support_fail_memory(diag);
    bool ok = true;
    for (uint32_t p = first; ok && go_on && p < v->surface->patch_count && p - first < count; p++) {
        if (v->patch_starts[p] == v->patch_starts[p + 1]) continue;
        const view_region *r = &g.region;
        g.coords.count = g.starts.count = 0;
        ok = !view_region_make(&g.region, v, &sights, p) && array_reserve(&v->alloc, &g.coords, 3 * r->corners.count) &&
             array_reserve(&v->alloc, &g.starts, r->starts.count);
        if (!ok) break;
        const geom_plane plane = view_plane_of(&v->sights, p);
        for (size_t i = 0; i < r->starts.count; i++) g.starts.data[i] = r->starts.data[i];
        for (size_t i = 0; i < r->corners.count; i++) {
            double ray[3];
            view_ray_at(v, r->corners.data[i], ray);
            view_point_on(&v->sights, &plane, ray, g.coords.data + 3 * i);
        }
        go_on = base_callback(fn(user, p, g.coords.data, g.starts.data, r->starts.count - 1));
    }
    view_region_free(&v->alloc, &g.region);
    array_free(&v->alloc, &g.coords);
    array_free(&v->alloc, &g.starts);
    view_sightlines_close(&sights);
    return ok ? FROE_OK : support_fail_memory(diag);
}
