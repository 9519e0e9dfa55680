/* others.c: cuts of small cells in space that are no supporting planes. */
#include "base/random.h"
#include "split/finish/table.h"

#define CHEAP 0.07 /* a cut that costs less than none by so much a piece is not bettered by planes across walls */

typedef struct search {
    finish *f;
    const table_part *part;
    const table_prices *prices;
    table_other *best;
} search;

/** A row of a part that is filled takes part. */
static void enter(search *s, const froe_cut *cut, const table_row *row) {
    const table_tally tally = table_count(s->f->t, s->part->set, row);
    const double cost = table_cost(s->prices, &tally);
    if (cost < s->best->cost && table_separates(s->prices, &tally)) *s->best = (table_other){*cut, *row, cost};
}

/* -------------------------------------------------------------------- axes -- */

/** Ends of all pieces of a part on an axis, rounded to floats: to count with, four at a time. */
typedef struct ends {
    float lo[TABLE_ROOM], hi[TABLE_ROOM];
    double value[2 * TABLE_ROOM];
    uint32_t room; /* pieces, rounded up */
} ends;

static void gather(const search *s, int axis, ends *out) {
    const table_planes *p = &s->f->t->planes;
    uint32_t n = 0;
    for (table_mask left = s->part->set; left; n++) {
        const uint32_t i = table_take(&left);
        out->value[2 * n] = p->lo[axis][i];
        out->value[2 * n + 1] = p->hi[axis][i];
        out->lo[n] = (float)(p->lo[axis][i] - p->centre[axis]);
        out->hi[n] = (float)(p->hi[axis][i] - p->centre[axis]);
    }
    for (; n % 4; n++) out->lo[n] = INFINITY, out->hi[n] = -INFINITY;
    out->room = n;
}

/** The pieces beside x[axis] = value; as whole objects or images have them. */
static table_row row_at(const search *s, int axis, double value) {
    const table_planes *p = &s->f->t->planes;
    table_row row = {s->part->set, 0, 0, 0};
    for (table_mask left = s->part->set; left;) {
        const uint32_t i = table_take(&left);
        const double lo = p->lo[axis][i], hi = p->hi[axis][i], e = p->all.error[i] / p->scale;
        const bool vague = p->vague & table_bit(i), exact = !vague && (e == 0 || lo - e > value || hi + e < value);
        table_put(&row.below, table_bit(i), lo < value - e);
        table_put(&row.above, table_bit(i), hi > value + e);
        table_put(&row.sure, table_bit(i), exact);
    }
    return row;
}

/** Of the planes across an axis through ends of pieces the best. */
static void enter_axis(search *s, int axis) {
    const table_prices *p = s->prices;
    const uint32_t most = s->f->config->quantiles, m = p->m, tries = 2 * m < most ? 2 * m : most;
    ends e;
    double least = s->best->cost, at = 0;
    gather(s, axis, &e);
    for (uint32_t i = 0; i < tries; i++) {
        const uint32_t pick = (2 * i + 1) * m / tries;
        const float value = pick & 1 ? e.hi[pick / 2] : e.lo[pick / 2];
        int32_t a = 0, b = 0, splits = 0;
        for (uint32_t j = 0; j < e.room; j++) {
            a += e.lo[j] < value;
            b += e.hi[j] > value;
            splits += (e.lo[j] < value) & (e.hi[j] > value);
        }
        const table_tally tally = {(uint32_t)a, (uint32_t)b, (uint32_t)splits};
        const double cost = table_cost(p, &tally);
        if (cost >= least || !table_separates(p, &tally)) continue;
        least = cost;
        at = e.value[pick];
    }
    if (least >= s->best->cost) return;
    const froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = axis, .value = at};
    const table_row row = row_at(s, axis, at);
    enter(s, &cut, &row);
}

/* ---------------------------------------------------- planes through vertices -- */

/** Is the triangle of three vertices too thin to give a plane worth trying? */
static bool too_thin(const finish *f, const uint32_t *id, const table_plane *plane) {
    double longest = 0;
    const double *n = plane->n, scale = f->t->planes.scale;
    for (int i = 0; i < 3; i++) {
        const double *p = scene_vertex(f->set->scene, id[i]), *q = scene_vertex(f->set->scene, id[(i + 1) % 3]);
        double square = 0;
        for (int k = 0; k < 3; k++) square += (p[k] - q[k]) * scale * ((p[k] - q[k]) * scale);
        longest = filter_greater(longest, square);
    }
    const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    return !(square > SPLIT_THIN * SPLIT_THIN * longest * longest) || !(square < INFINITY);
}

/** Through an edge of an object and a vertex. */
static void enter_vertices(search *s, uint64_t draw, uint32_t object, uint32_t vertex) {
    finish *f = s->f;
    const froe_scene *scene = f->set->scene;
    const uint32_t n = scene_corners(scene, object), corner = base_below(base_mix(draw + 1), n);
    froe_cut cut = {.kind = FROE_CUT_VERTICES};
    cut.id[0] = scene_corner(scene, object, corner);
    cut.id[1] = scene_corner(scene, object, corner + 1 < n ? corner + 1 : 0);
    cut.id[2] = vertex;
    if (cut.id[2] == cut.id[0] || cut.id[2] == cut.id[1]) return;
    const table_plane plane = table_plane_of(f, &cut);
    if (too_thin(f, cut.id, &plane)) return;
    table_row row = {.known = s->part->set};
    table_fill_part(f->t, &plane, &row);
    if (f->set->context.first != NUM_FILTER) row.sure = 0;
    enter(s, &cut, &row);
}

/** The i-th piece of a part. */
static uint32_t piece_of(const search *s, uint32_t i) {
    table_mask left = s->part->set;
    while (i--) left &= left - 1;
    return (uint32_t)__builtin_ctzll(left);
}

static uint32_t drawn_object(const search *s, uint64_t draw) {
    return s->f->t->piece[piece_of(s, base_below(draw, s->prices->m))].object;
}

/** Planes through an edge of one piece's object and a vertex of another's, as in refine.c: they halve fans. */
static void enter_edges(search *s) {
    const froe_scene *scene = s->f->set->scene;
    for (uint32_t i = 0; i < s->f->config->edges; i++) {
        const uint64_t draw = base_hash(s->f->config->seed, s->part->path, 100000 + i);
        const uint32_t one = drawn_object(s, draw), other = drawn_object(s, base_mix(draw + 2));
        const uint32_t corner = base_below(base_mix(draw + 3), scene_corners(scene, other));
        enter_vertices(s, draw, one, scene_corner(scene, other, corner));
    }
}

/** Planes through an edge and an outermost vertex of the scene, as in refine.c: they run across walls that are flat
 * only up to a rounding. */
static void enter_across(search *s, table_mask marked) {
    finish *f = s->f;
    const uint32_t m = s->prices->m, tries = f->config->supports * (m + table_size(marked)) / m;
    split_view *view = &((split_scratch *)f->work->scratch)->view;
    split_view_find_outermost(view, f->set->scene);
    for (uint32_t i = 0; i < tries; i++) {
        const uint64_t draw = base_hash(f->config->seed, s->part->path, 400000 + i);
        const uint32_t vertex = view->outermost[base_below(base_mix(draw + 2), view->outermost_count)];
        enter_vertices(s, draw, drawn_object(s, draw), vertex);
    }
}

void table_find_other(finish *f, const table_part *part, const table_prices *prices, double cost, table_other *out) {
    search s = {f, part, prices, out};
    out->cost = INFINITY;
    for (int axis = 0; axis < 3 && f->config->quantiles; axis++) enter_axis(&s, axis);
    const table_mask marked = f->t->marked & part->set;
    if (prices->strict || marked) table_pack_part(f->t, part->set);
    if (prices->strict) enter_edges(&s);
    if (marked && fmin(cost, out->cost) > -CHEAP * prices->m) enter_across(&s, marked);
}
