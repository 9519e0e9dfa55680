/* planes.c: rows of the table for planes. */
#include "split/finish/table.h"
#include "split/score/mark.h"

/* Of the table: images that are wrong by more are taken as they are, but nothing is sure of them. */
#define VAGUE 0x1p-40

/** Is there a finite image of the i-th corner? */
static bool finite_image(const finish *f, const split_fragment *piece, uint32_t i) {
    const double *x = split_image(f->set, piece, i);
    return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]);
}

/* Local coordinates of all images are at most 1/2. Halves that go beyond 1 have an infinite error. */
void table_begin_planes(finish *f, const split_cell *cell) {
    table_planes *p = &f->t->planes;
    double lo[3], hi[3], width = 0;
    int exponent = 0;
    bool any = false;
    for (uint32_t i = 0; i < cell->count; i++) {
        const split_fragment *piece = f->set->items.data + cell->first + i;
        const uint32_t n = split_corner_count(f->set, piece);
        for (uint32_t j = 0; j < n; j++) {
            const double *x = split_image(f->set, piece, j);
            if (!finite_image(f, piece, j)) continue;
            for (int k = 0; k < 3; k++) {
                lo[k] = any && lo[k] < x[k] ? lo[k] : x[k];
                hi[k] = any && hi[k] > x[k] ? hi[k] : x[k];
            }
            any = true;
        }
    }
    for (int k = 0; k < 3; k++) {
        p->centre[k] = any ? 0.5 * lo[k] + 0.5 * hi[k] : 0;
        width = filter_greater(width, any ? hi[k] - lo[k] : 0);
    }
    if (width > 0 && isfinite(width)) frexp(width, &exponent);
    p->scale = ldexp(1, exponent < -1000 ? 1000 : -exponent);
}

/** Its corners and extents; returns the greatest error. What is not finite becomes the centre, and its error infinite.
 */
static double load_corners(finish *f, uint32_t column, const split_fragment *piece, uint32_t n) {
    table_planes *p = &f->t->planes;
    double error = 0;
    for (uint32_t j = 0; j < n; j++) {
        const bool finite = finite_image(f, piece, j);
        const double *x = finite ? split_image(f->set, piece, j) : p->centre;
        const double wrong = piece->count ? f->set->corners.data[piece->first + j].error : 0;
        error = filter_greater(error, finite ? wrong : (double)INFINITY);
        for (int k = 0; k < 3; k++) {
            const double local = (x[k] - p->centre[k]) * p->scale;
            *(j < TABLE_FEW ? &p->all.x[k][j][column] : &p->more[k][j - TABLE_FEW][column]) = local;
            p->lo[k][column] = j && p->lo[k][column] < x[k] ? p->lo[k][column] : x[k];
            p->hi[k][column] = j && p->hi[k][column] > x[k] ? p->hi[k][column] : x[k];
            if (!(fabs(local) <= 1)) error = INFINITY;
        }
    }
    for (uint32_t j = n; j < TABLE_FEW; j++)
        for (int k = 0; k < 3; k++) p->all.x[k][j][column] = p->all.x[k][n - 1][column];
    return error;
}

void table_load_plane(finish *f, uint32_t column, const split_fragment *piece) {
    table_planes *p = &f->t->planes;
    const uint32_t n = split_corner_count(f->set, piece);
    const table_mask bit = table_bit(column);
    double width = 0;
    const double error = load_corners(f, column, piece, n) * p->scale;
    p->all.error[column] = error <= VAGUE ? error : VAGUE;
    table_put(&p->vague, bit, !(error <= VAGUE));
    p->all.bits[column] = bit;
    for (int k = 0; k < 3; k++) width = filter_greater(width, p->hi[k][column] - p->lo[k][column]);
    p->corners[column] = (uint8_t)n;
    table_put(&p->many, bit, n > TABLE_FEW);
    table_put(&p->most, bit, n == TABLE_CORNERS);
    table_put(&p->wide, bit, width * p->scale > SPLIT_WIDE);
}

/* A value is sum n[k] x[k] - d with d = sum n[k] o[k], where x and o are differences from the centre, rounded once. A
 * term suffers that rounding, one in the product and at most three in the sum, each charged 2u: 10 u P in all, where
 * P = sum |n[k]| (|x[k]| + |o[k]|) and |x[k]| <= 1. The error of the normal adds n_err sum (|x[k]| + |o[k]|). 16 u P
 * pays for the roundings here, too, and the scale is a power of two. */
table_plane table_plane_of(const finish *f, const froe_cut *cut) {
    const froe_scene *scene = f->set->scene;
    const table_planes *p = &f->t->planes;
    const double *at[3];
    double side[2][3], size = 0, spread = 0, sum = 0;
    for (uint32_t i = 0; i < 3; i++)
        at[i] = cut->kind == FROE_CUT_OBJECT ? scene_point(scene, cut->id[0], i) : scene_vertex(scene, cut->id[i]);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) side[i][k] = (at[i + 1][k] - at[0][k]) * p->scale;
    filter_vector u = filter_exact(side[0]), v = filter_exact(side[1]);
    u.e = 2 * FILTER_U * u.most;
    v.e = 2 * FILTER_U * v.most;
    const filter_vector normal = filter_cross(&u, &v);
    table_plane out = {{normal.x[0], normal.x[1], normal.x[2]}, 0, 0, 0};
    for (int k = 0; k < 3; k++) {
        const double o = (at[0][k] - p->centre[k]) * p->scale, most = 1 + fabs(o);
        out.d += out.n[k] * o;
        size += fabs(out.n[k]) * most;
        spread += most;
        sum += fabs(out.n[k]);
    }
    out.bound = (16 * FILTER_U * size + normal.e * spread * (1 + 0x1p-40)) * FILTER_UP + NUM_BALL_TINY;
    out.reach = (sum + 4 * normal.e) * (1 + 0x1p-40);
    if (!f->trusted) out.bound = INFINITY;
    return out;
}

void table_begin_plane(finish *f, uint32_t row, uint32_t object) {
    const froe_cut cut = {.kind = FROE_CUT_OBJECT, .id = {object}};
    f->t->planes.plane[row] = table_plane_of(f, &cut);
}

/** Two corners of so many pieces beside a plane. Two pieces go at a time, or more, where the machine can. */
static void fill_corners(const table_pack *pack, uint32_t n, const table_plane *plane, uint32_t j, table_row *row) {
    const double a = plane->n[0], b = plane->n[1], c = plane->n[2], d = plane->d;
    const double bound = plane->bound, reach = plane->reach;
    const double *x = pack->x[0][j], *y = pack->x[1][j], *z = pack->x[2][j];
    table_mask below[2] = {0, 0}, above[2] = {0, 0};
    for (uint32_t i = 0; i < n; i++) {
        const double u = a * x[i] + b * y[i] + c * z[i] - d;
        const double v = a * x[TABLE_ROOM + i] + b * y[TABLE_ROOM + i] + c * z[TABLE_ROOM + i] - d;
        const double e = bound + reach * pack->error[i];
        const table_mask here = pack->bits[i];
        below[0] |= u < -e ? here : 0;
        below[1] |= v < -e ? here : 0;
        above[0] |= u > e ? here : 0;
        above[1] |= v > e ? here : 0;
    }
    row->below |= below[0] | below[1];
    row->above |= above[0] | above[1];
    row->sure &= (below[0] | above[0]) & (below[1] | above[1]);
}

/** -1, 1 or NUM_UNSURE: the j-th corner of a piece. */
static int side_of_corner(const table_planes *p, const table_plane *plane, uint32_t column, uint32_t j) {
    double value = -plane->d;
    for (int k = 0; k < 3; k++)
        value += plane->n[k] * (j < TABLE_FEW ? p->all.x[k][j][column] : p->more[k][j - TABLE_FEW][column]);
    return filter_sign((num_ball){value, plane->bound + plane->reach * p->all.error[column]});
}

/** Corners of a piece, from the one numbered `from` on. */
static void place_corners(const table_planes *p, const table_plane *plane, table_row *row, uint32_t column,
                          uint32_t from) {
    const table_mask bit = table_bit(column);
    for (uint32_t j = from; j < p->corners[column]; j++) {
        const int side = side_of_corner(p, plane, column, j);
        row->below |= side == -1 ? bit : 0;
        row->above |= side == 1 ? bit : 0;
        row->sure &= side == NUM_UNSURE ? ~bit : ~(table_mask)0;
    }
}

static void fill(const table_planes *p, const table_pack *pack, uint32_t n, table_mask set, const table_plane *plane,
                 table_row *row) {
    row->below = row->above = 0;
    row->sure = ~(table_mask)0;
    for (uint32_t j = 0; j < TABLE_FEW; j += 2) fill_corners(pack, n, plane, j, row);
    for (table_mask many = p->many & set; many;) place_corners(p, plane, row, table_take(&many), TABLE_FEW);
    row->sure &= ~p->vague;
}

void table_fill_plane(const split_table *t, const table_plane *plane, table_row *row) {
    fill(&t->planes, &t->planes.all, t->columns, ~(table_mask)0 >> (TABLE_ROOM - t->columns), plane, row);
}

void table_place_plane(const split_table *t, const table_plane *plane, table_row *row, uint32_t column) {
    const table_mask bit = table_bit(column);
    row->below &= ~bit;
    row->above &= ~bit;
    row->sure |= bit;
    place_corners(&t->planes, plane, row, column, 0);
    row->sure &= ~t->planes.vague;
}

void table_pack_part(split_table *t, table_mask set) {
    const table_pack *all = &t->planes.all;
    table_pack *part = &t->planes.part;
    uint32_t n = 0;
    for (; set; n++) {
        const uint32_t i = table_take(&set);
        for (int k = 0; k < 3; k++)
            for (uint32_t j = 0; j < TABLE_FEW; j++) part->x[k][j][n] = all->x[k][j][i];
        part->error[n] = all->error[i];
        part->bits[n] = all->bits[i];
    }
    t->planes.packed = n;
}

void table_fill_part(const split_table *t, const table_plane *plane, table_row *row) {
    fill(&t->planes, &t->planes.part, t->planes.packed, row->known, plane, row);
}

/* ----------------------------------------------------------- exact classes -- */

table_exact table_exact_of(const finish *f, const froe_cut *cut) {
    const froe_scene *scene = f->set->scene;
    table_exact out = {.plane = split_plane_of(scene, cut), .filter = table_plane_of(f, cut)};
    const uint32_t n = cut->kind == FROE_CUT_OBJECT ? scene_corners(scene, cut->id[0]) : 3;
    for (; out.count < n && out.count < TABLE_MET; out.count++)
        out.vertex[out.count] =
            cut->kind == FROE_CUT_OBJECT ? scene_corner(scene, cut->id[0], out.count) : cut->id[out.count];
    if (f->set->context.first != NUM_FILTER) out.filter.bound = INFINITY;
    return out;
}

static int side_of_vertex(finish *f, table_exact *e, uint32_t vertex) {
    for (uint32_t i = 0; i < e->count; i++)
        if (e->vertex[i] == vertex) return e->side[i];
    const int side = split_vertex_side(f->set, &e->plane, scene_vertex(f->set->scene, vertex));
    if (e->count < TABLE_MET) {
        e->vertex[e->count] = vertex;
        e->side[e->count++] = (int8_t)side;
    }
    return side;
}

/* Corners far from the plane come first, then vertices, and corners that cuts made only if these do not tell. */
int table_class(finish *f, table_exact *e, uint32_t column) {
    split_set *set = f->set;
    const split_fragment *piece = f->t->piece + column;
    const split_corner *ring = piece->count ? set->corners.data + piece->first : NULL;
    const uint32_t n = split_corner_count(set, piece);
    bool seen[3] = {false, false, false};
    const bool vague = f->t->planes.vague & table_bit(column);
    uint32_t near[TABLE_CORNERS], count = 0, made = 0;
    for (uint32_t j = 0; j < n; j++) {
        const int side = vague ? NUM_UNSURE : side_of_corner(&f->t->planes, &e->filter, column, j);
        if (side == NUM_UNSURE)
            near[count++] = j;
        else
            seen[1 + side] = true;
    }
    for (uint32_t k = 0; k < count && !(seen[0] && seen[2]); k++) {
        const split_corner *corner = ring ? ring + near[k] : NULL;
        if (corner && corner->type != SPLIT_VERTEX)
            near[made++] = near[k];
        else
            seen[1 + side_of_vertex(f, e, corner ? corner->a : scene_corner(set->scene, piece->object, near[k]))] =
                true;
    }
    for (uint32_t k = 0; k < made && !(seen[0] && seen[2]); k++)
        seen[1 + split_corner_side(set, &e->plane, piece->object, ring + near[k])] = true;
    return seen[0] ? (seen[2] ? SPLIT_BOTH : SPLIT_NEG) : seen[2] ? SPLIT_POS : SPLIT_ON;
}
