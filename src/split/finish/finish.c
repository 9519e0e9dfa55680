/* finish.c: small cells of segments or polygons: the table is filled, then cut by masks. */
#include "base/random.h"
#include "split/fallback.h"
#include "split/finish/table.h"

enum { SEARCHES = 3 }; /* for other cuts of a part, at most */

split_table *split_table_new(const froe_allocator *alloc) {
    return support_calloc(alloc, 1, sizeof(split_table));
}

void split_table_free(const froe_allocator *alloc, split_table *table) {
    support_free(alloc, table, sizeof *table);
}

static bool in_space(const finish *f) {
    return f->set->scene->dim == 3;
}

/* ---------------------------------------------------------------- the table -- */

static void load_piece(finish *f, uint32_t column, const split_fragment *piece) {
    f->t->piece[column] = *piece;
    table_put(&f->t->free, table_bit(column), split_is_free(f->set, piece));
    in_space(f) ? table_load_plane(f, column, piece) : table_load_line(f, column, piece);
}

/** Fills a row for the pieces of a set: all columns at once where that is quicker. */
static void fill_row(finish *f, uint32_t row, table_mask set) {
    split_table *t = f->t;
    const bool space = in_space(f);
    table_row *r = t->rows + row, all;
    if (4 * table_size(set) < t->columns) {
        for (table_mask left = set; left;) {
            const uint32_t column = table_take(&left);
            space ? table_place_plane(t, t->planes.plane + row, r, column)
                  : table_place_line(t, t->lines.line + row, r, column);
        }
    } else {
        space ? table_fill_plane(t, t->planes.plane + row, &all) : table_fill_line(t, t->lines.line + row, &all);
        r->below = (r->below & ~set) | (all.below & set);
        r->above = (r->above & ~set) | (all.above & set);
        r->sure = (r->sure & ~set) | (all.sure & set);
    }
    if (f->set->context.first != NUM_FILTER) r->sure &= ~set;
    r->known |= set;
}

/** The row of a piece's own line or plane, filled for all pieces of a set. */
static table_row *row_of(finish *f, uint32_t piece, table_mask set) {
    table_row *r = f->t->rows + f->t->line[piece];
    const table_mask missing = set & ~r->known;
    if (!missing) return r;
    fill_row(f, f->t->line[piece], missing);
    r->below &= ~table_bit(piece);
    r->above &= ~table_bit(piece);
    r->sure |= table_bit(piece);
    return r;
}

/* ------------------------------------------------------------------- choice -- */

static table_prices prices_of(const finish *f, const table_part *p) {
    const uint32_t m = table_size(p->set);
    const double whole = f->xlog2[m];
    const bool strict = m > 4 && split_balance_due(f->config, p->depth, whole / m);
    return (table_prices){f->xlog2, f->config->weight, whole, strict ? 0.75 * m : (double)INFINITY, m, strict};
}

/** The piece whose line or plane is the best cut of a part that is not empty, with its cost. *good: hardly any cut is
 * better, or one that costs nothing is due. */
static uint32_t choose_piece(finish *f, const table_part *p, const table_prices *prices, double *cost, bool *good) {
    const table_mask free = f->config->free_cuts ? p->set & f->t->free : 0;
    uint32_t best = FROE_NONE;
    *good = free != 0;
    for (table_mask left = free ? free : p->set; left;) {
        const uint32_t i = table_take(&left);
        const table_tally tally = table_count(f->t, p->set, row_of(f, i, p->set));
        const double price = table_cost(prices, &tally);
        if (best != FROE_NONE && price >= *cost) continue;
        best = i;
        *cost = price;
        if (tally.both || 4 * table_larger(&tally) > 3 * (tally.below + tally.above) + 2) continue;
        *good = true;
        break;
    }
    return best;
}

/** Classes of pieces beside a plane, exactly; axes need no table. */
static froe_status classify(finish *f, table_row *r, const froe_cut *by, table_mask set) {
    const bool planes = in_space(f) && by->kind != FROE_CUT_AXIS;
    const split_plane plane = planes ? (split_plane){0} : split_plane_of(f->set->scene, by);
    table_exact exact;
    if (planes) exact = table_exact_of(f, by);
    while (set) {
        const uint32_t i = table_take(&set);
        const table_mask bit = table_bit(i), flat = bit & ~(r->below | r->above);
        f->set->sides.count = 0;
        if (!array_reserve(&f->set->alloc, &f->set->sides, split_corner_count(f->set, f->t->piece + i)))
            return FROE_E_MEMORY;
        const int class = planes ? table_class(f, &exact, i) : split_class(f->set, &plane, f->t->piece + i);
        table_put(&r->below, bit, class == SPLIT_NEG || class == SPLIT_BOTH);
        table_put(&r->above, bit, class == SPLIT_POS || class == SPLIT_BOTH);
        if (planes && class != SPLIT_ON && f->config->checks) f->t->marked |= flat & f->t->planes.wide;
    }
    return FROE_OK;
}

/** Makes a row the exact answer for the pieces of a set, and marks those that only seemed to lie in its plane. */
static froe_status make_sure(finish *f, table_row *r, const froe_cut *by, table_mask set) {
    num_context *context = &f->set->context;
    const uint32_t known = (uint32_t)f->set->scene->dim * table_size(set & r->sure);
    const table_mask left = set & ~r->sure;
    context->stats.calls += known;
    context->stats.filtered += known;
    const froe_status status = left ? classify(f, r, by, left) : FROE_OK;
    r->sure |= left;
    return status;
}

/** Makes the row of a piece exact for a part, and names the cut along it, or along its lowest equal, with its row. */
static froe_status confirm_piece(finish *f, const table_part *p, uint32_t piece, froe_cut *by, table_row *row) {
    for (;;) {
        table_row *r = row_of(f, piece, p->set);
        *by = (froe_cut){.kind = FROE_CUT_OBJECT, .id = {f->t->piece[piece].object}};
        froe_status status = make_sure(f, r, by, p->set);
        *row = *r;
        /* of equal objects the lowest id serves as the cut */
        table_mask on = p->set & ~(r->below | r->above);
        const split_fragment *all = f->t->piece;
        uint32_t lowest = piece;
        for (on &= ~table_bit(piece); on;) {
            uint32_t i = table_take(&on);
            if (all[i].object < all[lowest].object && scene_equal(f->set->scene, all[i].object, all[lowest].object))
                lowest = i;
        }
        if (status || lowest == piece) return status;
        piece = lowest;
    }
}

/** Makes the row of another cut exact, and prices it again. */
static froe_status confirm_other(finish *f, const table_part *p, const table_prices *prices, table_other *other) {
    if (other->cut.kind == FROE_CUT_VERTICES) {
        const geom_plane plane = scene_cut_plane(f->set->scene, &other->cut);
        other->cost = INFINITY;
        if (!geom_plane_valid(&f->set->context, &plane)) return FROE_OK;
    }
    const froe_status status = make_sure(f, &other->row, &other->cut, p->set);
    const table_tally tally = table_count(f->t, p->set, &other->row);
    other->cost = table_separates(prices, &tally) ? table_cost(prices, &tally) : (double)INFINITY;
    return status;
}

/** The best cut of a part: what seems to be the best is made exact, until it is no worse for that. In the plane, and
 * without checks, the first one serves. */
static froe_status choose_exactly(finish *f, const table_part *p, froe_cut *by, table_row *row) {
    const table_prices prices = prices_of(f, p);
    table_other other = {.cost = INFINITY};
    froe_status status = FROE_OK;
    const bool doubt = in_space(f) && f->config->checks;
    bool search = in_space(f);
    for (uint32_t searches = 0; !status;) {
        double cost = INFINITY;
        bool good;
        const uint32_t piece = choose_piece(f, p, &prices, &cost, &good);
        if (search && !good) {
            table_find_other(f, p, &prices, cost, &other);
            search = false;
            searches++;
        }
        if (!good && other.cost < cost) {
            const double seemed = other.cost;
            const table_mask marked = f->t->marked;
            status = confirm_other(f, p, &prices, &other);
            *by = other.cut;
            *row = other.row;
            if (other.cost <= seemed || (!doubt && other.cost < INFINITY)) break;
            search = searches < SEARCHES && f->t->marked != marked;
            continue;
        }
        status = confirm_piece(f, p, piece, by, row);
        if (!doubt || status) break;
        const table_tally tally = table_count(f->t, p->set, row_of(f, piece, p->set));
        if (table_cost(&prices, &tally) <= cost) break;
    }
    return status;
}

/* ---------------------------------------------------------------------- cut -- */

/** Lists pieces at a node. */
static froe_status list(finish *f, uint32_t node, table_mask set) {
    if (!set) return FROE_OK;
    froe_status status = draft_list(f->set->draft, node - f->set->draft->outer);
    while (set && !status) status = split_emit(f->set, node, f->t->piece + table_take(&set));
    return status;
}

/** Divides a piece; the rows of `set` learn about its halves. */
static froe_status divide_piece(finish *f, const split_plane *plane, uint32_t node, uint32_t column, table_mask set) {
    split_set *s = f->set;
    split_table *t = f->t;
    split_fragment whole = t->piece[column], below, above;
    uint32_t other = t->columns++;
    s->sides.count = 0;
    if (!array_reserve(&s->alloc, &s->sides, split_corner_count(s, &whole))) return FROE_E_MEMORY;
    split_classify(s, plane, &whole);
    froe_status status = split_divide(s, plane, node, &whole, s->sides.data, &below, &above);
    if (status) return status;
    load_piece(f, column, &below);
    load_piece(f, other, &above);
    t->line[other] = t->line[column];
    t->marked |= t->marked & table_bit(column) ? table_bit(other) : 0;
    /* a row knows where both halves lie if it knew that for the whole, unless that was both sides */
    const table_mask one = table_bit(column), half = table_bit(other);
    while (set) {
        table_row *r = t->rows + t->line[table_take(&set)];
        table_put(&r->known, one | half, r->known & ~(r->below & r->above) & one);
        table_put(&r->below, half, r->below & one);
        table_put(&r->above, half, r->above & one);
        table_put(&r->sure, half, r->sure & one);
    }
    return FROE_OK;
}

/** Pushes all parts, the topmost too, as ordinary cells. */
static froe_status give_back(finish *f, split_work *work) {
    split_set *s = f->set;
    const split_table *t = f->t;
    if (!array_reserve(&s->alloc, &work->cells, t->parts) || !array_reserve(&s->alloc, &s->items, TABLE_ROOM))
        return FROE_E_MEMORY;
    for (uint32_t i = 0; i < t->parts; i++) {
        const table_part *p = t->stack + i;
        work->cells.data[work->cells.count++] = (split_cell){.node = p->node,
                                                             .depth = p->depth,
                                                             .path = p->path,
                                                             .first = (uint32_t)s->items.count,
                                                             .count = table_size(p->set),
                                                             .corner_top = p->corner_top,
                                                             .guard = FROE_NONE};
        for (table_mask left = p->set; left;) s->items.data[s->items.count++] = t->piece[table_take(&left)];
    }
    return FROE_OK;
}

/** Is there room for the halves of so many pieces? */
static bool has_room(const finish *f, table_mask both) {
    const split_table *t = f->t;
    return t->columns + table_size(both) <= TABLE_ROOM && !(in_space(f) && both & t->planes.most);
}

/** Cuts a part in two. *full: there is no room, nothing is done. */
static froe_status cut_part(finish *f, const table_part *p, bool *full) {
    split_table *t = f->t;
    tree_draft *draft = f->set->draft;
    froe_cut by;
    table_row r;
    uint32_t child;
    froe_status status = choose_exactly(f, p, &by, &r);
    if (status) return status;
    table_mask below = r.below & p->set, above = r.above & p->set, both = below & above, upper = 0;
    *full = !has_room(f, both);
    if (*full) return FROE_OK;
    status = draft_split(draft, p->node - draft->outer, &by, 0, &child);
    if (!status) status = list(f, p->node, p->set & ~(below | above));
    /* divides what the cut splits: lower halves stay in their columns, `upper` are the others */
    if (both) {
        const split_plane plane = split_plane_of(f->set->scene, &by);
        for (table_mask left = both; left && !status;) {
            upper |= table_bit(t->columns);
            status = divide_piece(f, &plane, p->node, table_take(&left), below | above);
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

static froe_status do_part(finish *f, const table_part *p, bool *full) {
    f->set->corners.count = p->corner_top;
    f->t->columns = p->columns;
    if (table_size(p->set) > f->config->leaf) return cut_part(f, p, full);
    draft_leaf(f->set->draft, p->node - f->set->draft->outer, 0);
    return list(f, p->node, p->set);
}

static bool fits_table(const split_refine *config, const split_set *set, const split_cell *cell) {
    const int dim = set->scene->dim;
    if (dim > 3 || cell->covers || cell->count > config->small || !cell->count) return false;
    if (dim == 3 && (cell->plain || cell->attempt || cell->count <= config->leaf)) return false;
    for (uint32_t i = 0; i < cell->count; i++) {
        const split_fragment *piece = set->items.data + cell->first + i;
        if (scene_form(set->scene, piece->object) != (dim == 2 ? FROE_SEGMENT : FROE_POLYGON)) return false;
        if (split_corner_count(set, piece) > TABLE_CORNERS) return false;
    }
    return true;
}

/** Fills the table with a cell. */
static void begin_table(finish *f, const split_cell *cell) {
    split_table *t = f->t;
    t->columns = cell->count;
    t->marked = 0;
    in_space(f) ? table_begin_planes(f, cell) : table_begin_lines(f);
    for (uint32_t i = 0; i < cell->count; i++) load_piece(f, i, f->set->items.data + cell->first + i);
    for (uint32_t i = 0; i < cell->count; i++) {
        const uint32_t object = t->piece[i].object;
        t->line[i] = (uint8_t)i;
        t->rows[i] = (table_row){0};
        in_space(f) ? table_begin_plane(f, i, object) : table_begin_line(f, i, object);
    }
    t->parts = 1;
    t->stack[0] = (table_part){.set = ~(table_mask)0 >> (TABLE_ROOM - cell->count),
                               .path = cell->path,
                               .node = cell->node,
                               .depth = cell->depth,
                               .corner_top = (uint32_t)f->set->corners.count,
                               .columns = cell->count};
}

froe_status split_finish(const split_refine *config, split_work *work, const split_cell *cell, bool *done) {
    split_scratch *scratch = work->scratch;
    split_table *t = scratch->table;
    finish f = {config, work, &work->set, t, scratch->price.xlog2, num_rounding_trusted()};
    bool full = false;
    froe_status status = FROE_OK;
    *done = fits_table(config, &work->set, cell);
    if (!*done) return FROE_OK;
    begin_table(&f, cell);
    while (t->parts && !full && !status) {
        table_part p = t->stack[--t->parts];
        work->deepest = p.depth > work->deepest ? p.depth : work->deepest;
        work->tests += table_size(p.set);
        status = do_part(&f, &p, &full);
    }
    t->parts += full;                                /* p is still there: it has no columns for its halves */
    *done = !full || t->stack[0].node != cell->node; /* else its very first cut splits too much for the table */
    if (*done) work->set.items.count = cell->first;
    return *done && full && !status ? give_back(&f, work) : status;
}
