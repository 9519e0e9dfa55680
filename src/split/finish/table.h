/* table.h: the table of a small cell: a column for each piece, a row for each line or plane (finish.h).
 *
 * A set of pieces is a mask, so counting bits tells how a row deals with a cell. Rows are filled by filters, in loops
 * without branches, and say for which pieces the filter is sure; the row that becomes the cut is made exact.
 * lines.c fills rows for segments of the plane, planes.c for polygons in space. */
#ifndef FROE_SPLIT_FINISH_TABLE_H
#define FROE_SPLIT_FINISH_TABLE_H
#include "geom/filter.h"
#include "split/finish/finish.h"

enum {
    TABLE_ROOM = 64,   /* columns: as many as a mask has bits */
    TABLE_CORNERS = 8, /* of a polygon, at most */
    TABLE_FEW = 4      /* of nearly all of them */
};

typedef uint64_t table_mask; /* a set of columns */

typedef struct table_row {
    table_mask known;        /* pieces for which the row is filled */
    table_mask below, above; /* with an end or corner there, by more than rounding could do */
    table_mask sure;         /* for which below and above are the exact answer */
} table_row;

/** A cell that is still to be cut. */
typedef struct table_part {
    table_mask set;
    uint64_t path;
    uint32_t node, depth, corner_top, columns;
} table_part;

/** Of segments: images of both ends, and the box of all images so far. */
typedef struct table_lines {
    double x[2][TABLE_ROOM], y[2][TABLE_ROOM];
    double error[TABLE_ROOM];    /* of both images */
    table_mask bits[TABLE_ROOM]; /* bits[i] = 1 << i */
    double lo[2], hi[2];
    filter_line line[FINISH_MOST];
} table_lines;

/** A plane: n . x = d for local x; a value is wrong by at most `bound`, and by `reach` times the error of x. */
typedef struct table_plane {
    double n[3], d, bound, reach;
} table_plane;

/** Corners of polygons, local: the last of them is repeated to make four; those beyond are in table_planes.more. */
typedef struct table_pack {
    double x[3][TABLE_FEW][TABLE_ROOM];
    double error[TABLE_ROOM];    /* of all corners of a piece */
    table_mask bits[TABLE_ROOM]; /* of what column each is */
} table_pack;

/** Of polygons: local coordinates are (x - centre) scale, by a power of two that makes the cell about 1 wide. */
typedef struct table_planes {
    table_pack all, part; /* of all columns; of the part at hand, one after the other */
    uint32_t packed;      /* pieces in `part` */
    double more[3][TABLE_CORNERS - TABLE_FEW][TABLE_ROOM];
    double lo[3][TABLE_ROOM], hi[3][TABLE_ROOM]; /* extents, absolute */
    double centre[3], scale;
    uint8_t corners[TABLE_ROOM];
    table_mask many;  /* pieces with more than four corners */
    table_mask vague; /* whose images may be wrong by more than they are said to be: no filter is sure of them */
    table_mask most;  /* with as many as there may be */
    table_mask wide;  /* wide enough beside the table to be a wall (score/mark.h) */
    table_plane plane[FINISH_MOST];
} table_planes;

struct split_table {
    split_fragment piece[TABLE_ROOM];
    table_mask free;          /* pieces that cross their cell from border to border */
    table_mask marked;        /* that seemed to lie in a plane and do not (score/mark.h) */
    uint8_t line[TABLE_ROOM]; /* the row of the piece's own line or plane */
    uint32_t columns;
    table_row rows[FINISH_MOST];
    table_part stack[TABLE_ROOM + 2]; /* a cut takes a piece out, or leaves less on both sides: no path is longer */
    uint32_t parts;
    union {
        table_lines lines;
        table_planes planes;
    };
};

/** A row that is no piece's own: of the best of the other cuts of a part. */
typedef struct table_other {
    froe_cut cut;
    table_row row;
    double cost; /* INFINITY: there is none */
} table_other;

/** What all prices of a part have in common. */
typedef struct table_prices {
    const double *xlog2; /* of split_price */
    double weight, whole, most;
    uint32_t m;
    bool strict;
} table_prices;

typedef struct finish {
    const split_refine *config;
    split_work *work;
    split_set *set;
    split_table *t;
    const double *xlog2; /* of split_price */
    bool trusted;        /* num_rounding_trusted() */
} finish;

static inline table_mask table_bit(uint32_t column) {
    return (table_mask)1 << column;
}

/** Takes the lowest column out of a set that is not empty. */
static inline uint32_t table_take(table_mask *set) {
    uint32_t column = (uint32_t)__builtin_ctzll(*set);
    *set &= *set - 1;
    return column;
}

static inline uint32_t table_size(table_mask set) { /* baseline x86-64 has no instruction for it */
    set -= set >> 1 & 0x5555555555555555u;
    set = (set & 0x3333333333333333u) + (set >> 2 & 0x3333333333333333u);
    set = (set + (set >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (uint32_t)(set * 0x0101010101010101u >> 56);
}

static inline void table_put(table_mask *set, table_mask which, bool in) {
    *set = in ? *set | which : *set & ~which;
}

/** How a row deals with a part; pieces in both are in the other two as well. */
typedef struct table_tally {
    uint32_t below, above, both;
} table_tally;

static inline table_tally table_count(const split_table *t, table_mask set, const table_row *r) {
    table_mask below = r->below & set, above = r->above & set;
    if (t->marked) {
        const table_mask falsely = set & t->marked & ~(below | above | r->sure);
        below |= falsely;
        above |= falsely;
    }
    return (table_tally){table_size(below), table_size(above), table_size(below & above)};
}

static inline uint32_t table_larger(const table_tally *t) {
    return t->below > t->above ? t->below : t->above;
}

static inline bool table_separates(const table_prices *p, const table_tally *t) {
    return (t->below && t->above) || t->below + t->above - t->both < p->m;
}

static inline double table_cost(const table_prices *p, const table_tally *t) {
    const double gain = split_gain(p->whole, p->m, p->xlog2[t->below], p->xlog2[t->above], t->both);
    return t->both - p->weight * gain + split_penalty(table_larger(t), p->most, p->m);
}

/** Before the first piece is loaded. */
void table_begin_lines(finish *f);
void table_begin_planes(finish *f, const split_cell *cell);
/** Fills what is above the rows in a piece's column. */
void table_load_line(finish *f, uint32_t column, const split_fragment *piece);
void table_load_plane(finish *f, uint32_t column, const split_fragment *piece);
/** The line or plane of the object of a piece becomes a row. */
void table_begin_line(finish *f, uint32_t row, uint32_t object);
void table_begin_plane(finish *f, uint32_t row, uint32_t object);
/** Fills a row for all columns, or for one. */
void table_fill_line(const split_table *t, const filter_line *line, table_row *row);
void table_fill_plane(const split_table *t, const table_plane *plane, table_row *row);
void table_place_line(const split_table *t, const filter_line *line, table_row *row, uint32_t column);
void table_place_plane(const split_table *t, const table_plane *plane, table_row *row, uint32_t column);
/** The same for the pieces of a part, in planes.part once they are packed. */
void table_pack_part(split_table *t, table_mask set);
void table_fill_part(const split_table *t, const table_plane *plane, table_row *row);
/** A plane through three vertices or along an object, for filters. */
table_plane table_plane_of(const finish *f, const froe_cut *cut);

/** Such a plane for exact answers, and the vertices that it was compared with last: in a mesh six triangles have a
 * vertex in common. */
enum { TABLE_MET = 32 };
typedef struct table_exact {
    split_plane plane;
    table_plane filter;
    uint32_t count, vertex[TABLE_MET];
    int8_t side[TABLE_MET];
} table_exact;

table_exact table_exact_of(const finish *f, const froe_cut *cut);
/** Exact class of a piece. */
int table_class(finish *f, table_exact *exact, uint32_t column);

/** The best of the cuts of a part in space that are no supporting planes, of which the best has that cost. */
void table_find_other(finish *f, const table_part *part, const table_prices *prices, double cost, table_other *out);
#endif
