/* finish.c: small cells of segments: the table is filled, then cut by masks. */
#include "split/finish.h"
#include "base/random.h"
#include "geom/filter.h"
#include <string.h>

enum { ROOM = 64 }; /* columns: as many as a mask has bits */

typedef uint64_t mask; /* a set of columns */

/** The line of a piece that was there at the start, and its row. */
typedef struct table_row {
    filter_line line;
    mask known;        /* pieces for which the row is filled */
    mask below, above; /* with an end there, by more than rounding could do */
    mask sure;         /* for which below and above are the exact answer */
} table_row;

/** A cell that is still to be cut. */
typedef struct table_part {
    mask set;
    uint64_t path;
    uint32_t node, depth, corner_top, columns;
} table_part;

struct split_table {
    split_fragment piece[ROOM];
    double x[2][ROOM], y[2][ROOM]; /* images of both ends */
    double error[ROOM];            /* of both images */
    double lo[2], hi[2];           /* the box of all images so far */
    mask bits[ROOM];               /* bits[i] = 1 << i */
    mask free;                     /* pieces that cross their cell from border to border */
    uint8_t line[ROOM];            /* the row of the piece's own line */
    uint32_t columns;
    table_row rows[FINISH_MOST];
    table_part stack[ROOM + 2]; /* a cut takes a piece out, so no path is longer than ROOM */
    uint32_t parts;
};

typedef struct finish {
    const split_refine *config;
    split_set *set;
    split_table *t;
    const double *xlog2; /* of split_price */
} finish;

split_table *split_table_new(const froe_allocator *alloc) {
    split_table *t = support_calloc(alloc, 1, sizeof *t);
    for (uint32_t i = 0; t && i < ROOM; i++) t->bits[i] = (mask)1 << i;
    return t;
}

void split_table_free(const froe_allocator *alloc, split_table *table) {
    support_free(alloc, table, sizeof *table);
}

/* -------------------------------------------------------------------- masks -- */

static mask bit(uint32_t column) {
    return (mask)1 << column;
}

/** Takes the lowest column out of a set that is not empty. */
static uint32_t take_column(mask *set) {
    uint32_t column = (uint32_t)__builtin_ctzll(*set);
    *set &= *set - 1;
    return column;
}

static uint32_t size(mask set) { /* baseline x86-64 has no instruction for it */
    set -= set >> 1 & 0x5555555555555555u;
    set = (set & 0x3333333333333333u) + (set >> 2 & 0x3333333333333333u);
    set = (set + (set >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (uint32_t)(set * 0x0101010101010101u >> 56);
}

static void put_columns(mask *set, mask which, bool in) {
    *set = in ? *set | which : *set & ~which;
}

/* ---------------------------------------------------------------- the table -- */

static void stretch(split_table *t, int axis, double x) {
    t->lo[axis] = x < t->lo[axis] ? x : t->lo[axis];
    t->hi[axis] = x > t->hi[axis] ? x : t->hi[axis];
}

/** Fills what is above the rows in a piece's column. */
static void load_piece(finish *f, uint32_t column, const split_fragment *piece) {
    split_table *t = f->t;
    const split_corner *ring = f->set->corners.data + piece->first;
    t->piece[column] = *piece;
    t->error[column] = piece->count ? filter_greater(ring[0].error, ring[1].error) : 0;
    for (uint32_t i = 0; i < 2; i++) {
        const double *x = split_image(f->set, piece, i);
        stretch(t, 0, t->x[i][column] = x[0]);
        stretch(t, 1, t->y[i][column] = x[1]);
    }
    put_columns(&t->free, bit(column), piece->count && ring[0].edge & ring[1].edge & TREE_EDGE_CUT);
}

/** The greater distance of x from the ends of an interval. */
static double farthest(double lo, double hi, double x) {
    return filter_greater(fabs(lo - x), fabs(hi - x));
}

/** Fills a row for all columns, with one bound on all errors of values. Two pieces go at a time, or more, where the
 * machine can. */
static void fill_row(const split_table *t, table_row *r) {
    const filter_line h = r->line;
    const double reach = filter_line_reach(&h);
    const double bound =
        filter_line_bound(&h, farthest(t->lo[0], t->hi[0], h.o[0]), farthest(t->lo[1], t->hi[1], h.o[1]));
    mask below[2] = {0, 0}, above[2] = {0, 0};
    for (uint32_t i = 0; i < t->columns; i++) {
        double u = filter_line_value(&h, t->x[0][i], t->y[0][i]), v = filter_line_value(&h, t->x[1][i], t->y[1][i]);
        double e = bound + reach * t->error[i];
        mask here = t->bits[i];
        below[0] |= u < -e ? here : 0;
        below[1] |= v < -e ? here : 0;
        above[0] |= u > e ? here : 0;
        above[1] |= v > e ? here : 0;
    }
    r->below = below[0] | below[1];
    r->above = above[0] | above[1];
    r->sure = (below[0] | above[0]) & (below[1] | above[1]);
}

/** The row of a piece's line, filled for all pieces of a set. */
static table_row *row_of(finish *f, uint32_t piece, mask set) {
    split_table *t = f->t;
    table_row *r = t->rows + t->line[piece];
    mask missing = set & ~r->known;
    if (!missing) return r;
    if (4 * size(missing) >= t->columns)
        fill_row(t, r);
    else
        while (missing) {
            /* one place of a row */
            uint32_t column = take_column(&missing);
            const filter_line *h = &r->line;
            bool below = false, above = false, sure = true;
            for (int i = 0; i < 2; i++) {
                double x = t->x[i][column], y = t->y[i][column], value = filter_line_value(h, x, y);
                double e = filter_line_bound(h, fabs(x - h->o[0]), fabs(y - h->o[1])) +
                           filter_line_reach(h) * t->error[column];
                below |= value < -e;
                above |= value > e;
                sure &= (value < -e) | (value > e);
            }
            put_columns(&r->below, bit(column), below);
            put_columns(&r->above, bit(column), above);
            put_columns(&r->sure, bit(column), sure);
        }
    if (f->set->context.first != NUM_FILTER) r->sure = 0;
    r->known |= set;
    r->below &= ~bit(piece);
    r->above &= ~bit(piece);
    r->sure |= bit(piece);
    return r;
}

/* ------------------------------------------------------------------- choice -- */

/** The piece whose line is the best cut of a part that is not empty. */
static uint32_t choose_piece(finish *f, const table_part *p) {
    const split_table *t = f->t;
    const double *xl = f->xlog2;
    uint32_t m = size(p->set), best = 0;
    double whole = xl[m], least = INFINITY;
    bool strict = m > 4 && split_balance_due(f->config, p->depth, whole / m);
    double most = strict ? 0.75 * m : (double)INFINITY;
    mask left = f->config->free_cuts && p->set & t->free ? p->set & t->free : p->set;
    while (left) {
        uint32_t i = take_column(&left);
        const table_row *r = row_of(f, i, p->set);
        uint32_t splits = size(r->below & r->above & p->set);
        uint32_t a = size(r->below & p->set), b = size(r->above & p->set), larger = a > b ? a : b;
        double cost = splits - f->config->weight * split_gain(whole, m, xl[a], xl[b], splits);
        cost += split_penalty(larger, most, m);
        if (cost >= least) continue;
        least = cost;
        best = i;
        if (!splits && 4 * larger <= 3 * (a + b) + 2) break;
    }
    return best;
}

/* ---------------------------------------------------------------------- cut -- */

/** Lists pieces at a node. */
static froe_status list(finish *f, uint32_t node, mask set) {
    if (!set) return FROE_OK;
    froe_status status = draft_list(f->set->draft, node - f->set->draft->outer);
    while (set && !status) status = split_emit(f->set, node, f->t->piece + take_column(&set));
    return status;
}

/** Makes a row the exact answer for the pieces of a set. */
static froe_status make_sure(finish *f, table_row *r, const froe_cut *by, mask set) {
    num_context *context = &f->set->context;
    mask left = set & ~r->sure;
    uint32_t known = 2 * size(set & r->sure);
    context->stats.calls += known;
    context->stats.filtered += known;
    if (!left) return FROE_OK;
    split_plane plane = split_plane_of(f->set->scene, by);
    while (left) {
        uint32_t i = take_column(&left);
        f->set->sides.count = 0;
        if (!array_reserve(&f->set->alloc, &f->set->sides, 2)) return FROE_E_MEMORY;
        int class = split_classify(f->set, &plane, f->t->piece + i);
        put_columns(&r->below, bit(i), class == SPLIT_NEG || class == SPLIT_BOTH);
        put_columns(&r->above, bit(i), class == SPLIT_POS || class == SPLIT_BOTH);
        put_columns(&r->sure, bit(i), true);
    }
    return FROE_OK;
}

/** The cut along a piece, or along its lowest equal; its row, exact for this part. */
static froe_status find_exact_row(finish *f, const table_part *p, uint32_t piece, froe_cut *by, table_row **out) {
    for (;;) {
        table_row *r = row_of(f, piece, p->set);
        *by = (froe_cut){.kind = FROE_CUT_OBJECT, .id = {f->t->piece[piece].object}};
        *out = r;
        froe_status status = make_sure(f, r, by, p->set);
        /* of equal objects the lowest id serves as the cut */
        mask on = p->set & ~(r->below | r->above);
        const split_fragment *all = f->t->piece;
        uint32_t lowest = piece;
        for (on &= ~bit(piece); on;) {
            uint32_t i = take_column(&on);
            if (all[i].object < all[lowest].object && scene_equal(f->set->scene, all[i].object, all[lowest].object))
                lowest = i;
        }
        if (status || lowest == piece) return status;
        piece = lowest;
    }
}

/** Divides a piece; the rows of `set` learn about its halves. */
static froe_status divide_piece(finish *f, const split_plane *plane, uint32_t node, uint32_t column, mask set) {
    split_set *s = f->set;
    split_table *t = f->t;
    split_fragment whole = t->piece[column], below, above;
    uint32_t other = t->columns++;
    s->sides.count = 0;
    if (!array_reserve(&s->alloc, &s->sides, 2)) return FROE_E_MEMORY;
    split_classify(s, plane, &whole);
    froe_status status = split_divide(s, plane, node, &whole, s->sides.data, &below, &above);
    if (status) return status;
    load_piece(f, column, &below);
    load_piece(f, other, &above);
    t->line[other] = t->line[column];
    /* a row knows where both halves lie if it knew that for the whole, unless that was both sides */
    const mask one = bit(column), half = bit(other);
    while (set) {
        table_row *r = t->rows + t->line[take_column(&set)];
        put_columns(&r->known, one | half, r->known & ~(r->below & r->above) & one);
        put_columns(&r->below, half, r->below & one);
        put_columns(&r->above, half, r->above & one);
        put_columns(&r->sure, half, r->sure & one);
    }
    return FROE_OK;
}

/** Pushes all parts, the topmost too, as ordinary cells. */
static froe_status give_back(finish *f, split_work *work) {
    split_set *s = f->set;
    const split_table *t = f->t;
    if (!array_reserve(&s->alloc, &work->cells, t->parts) || !array_reserve(&s->alloc, &s->items, ROOM))
        return FROE_E_MEMORY;
    for (uint32_t i = 0; i < t->parts; i++) {
        const table_part *p = t->stack + i;
        work->cells.data[work->cells.count++] = (split_cell){.node = p->node,
                                                             .depth = p->depth,
                                                             .path = p->path,
                                                             .first = (uint32_t)s->items.count,
                                                             .count = size(p->set),
                                                             .corner_top = p->corner_top,
                                                             .guard = FROE_NONE};
        for (mask left = p->set; left;) s->items.data[s->items.count++] = t->piece[take_column(&left)];
    }
    return FROE_OK;
}

static froe_status do_part(finish *f, const table_part *p, bool *full) {
    split_table *t = f->t;
    f->set->corners.count = p->corner_top;
    t->columns = p->columns;
    if (size(p->set) > f->config->leaf) {
        /* too few columns: nothing is done */
        tree_draft *draft = f->set->draft;
        froe_cut by;
        table_row *r;
        uint32_t child;
        froe_status status = find_exact_row(f, p, choose_piece(f, p), &by, &r);
        if (status) return status;
        mask below = r->below & p->set, above = r->above & p->set, both = below & above, upper = 0;
        *full = t->columns + size(both) > ROOM;
        if (*full) return FROE_OK;
        status = draft_split(draft, p->node - draft->outer, &by, 0, &child);
        if (!status) status = list(f, p->node, p->set & ~(below | above));
        /* divides what the cut splits: lower halves stay in their columns, `upper` are the others */
        if (both) {
            const split_plane plane = split_plane_of(f->set->scene, &by);
            for (mask left = both; left && !status;) {
                upper |= bit(t->columns);
                status = divide_piece(f, &plane, p->node, take_column(&left), below | above);
            }
        }
        for (int k = 1; k >= 0 && !status; k--)
            t->stack[t->parts++] = (table_part){.set = k ? (above & ~both) | upper : below,
                                                .path = base_path(p->path, k),
                                                .node = draft->outer + child + (uint32_t)k,
                                                .depth = p->depth + 1,
                                                .corner_top = (uint32_t)f->set->corners.count,
                                                .columns = t->columns};
        return status;
    }
    draft_leaf(f->set->draft, p->node - f->set->draft->outer, 0);
    return list(f, p->node, p->set);
}

static bool fits_table(const split_refine *config, const split_set *set, const split_cell *cell) {
    if (set->scene->dim != 2 || cell->count > config->small || !cell->count) return false;
    for (uint32_t i = 0; i < cell->count; i++)
        if (scene_form(set->scene, set->items.data[cell->first + i].object) != FROE_SEGMENT) return false;
    return true;
}

froe_status split_finish(const split_refine *config, split_work *work, const split_cell *cell, bool *done) {
    split_scratch *scratch = work->scratch;
    split_table *t = scratch->table;
    finish f = {config, &work->set, t, scratch->price.xlog2};
    bool full = false;
    *done = fits_table(config, &work->set, cell);
    if (!*done) return FROE_OK;
    const bool trusted = num_rounding_trusted();
    t->columns = cell->count;
    for (int k = 0; k < 2; k++) t->lo[k] = INFINITY, t->hi[k] = -INFINITY;
    for (uint32_t i = 0; i < cell->count; i++) {
        const split_fragment *piece = work->set.items.data + cell->first + i;
        const double *p = scene_point(work->set.scene, piece->object, 0);
        load_piece(&f, i, piece);
        t->line[i] = (uint8_t)i;
        t->rows[i].line = filter_line_through(p, scene_point(work->set.scene, piece->object, 1), trusted);
        t->rows[i].known = 0;
    }
    t->parts = 1;
    t->stack[0] = (table_part){.set = ~(mask)0 >> (ROOM - cell->count),
                               .path = cell->path,
                               .node = cell->node,
                               .depth = cell->depth,
                               .corner_top = (uint32_t)work->set.corners.count,
                               .columns = cell->count};
    froe_status status = FROE_OK;
    while (t->parts && !full && !status) {
        table_part p = t->stack[--t->parts];
        work->deepest = p.depth > work->deepest ? p.depth : work->deepest;
        work->tests += size(p.set);
        status = do_part(&f, &p, &full);
    }
    t->parts += full;                                /* p is still there: it has no columns for its halves */
    *done = !full || t->stack[0].node != cell->node; /* else its very first cut splits too much for the table */
    if (*done) work->set.items.count = cell->first;
    return *done && full && !status ? give_back(&f, work) : status;
}
