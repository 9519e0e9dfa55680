/* maker.h: what the generators of scenes share.
 *
 * Coordinates come from + - * / sqrt and an integer hash alone: no trigonometry, no
 * logarithm, nothing that differs between mathematical libraries. Directions are
 * rational points of the unit circle, ((1-t^2)/(1+t^2), 2t/(1+t^2)). Failures stick:
 * after the first nothing more is added. One expression asks for at most one random
 * number, for C leaves the order of calls within an expression to the compiler. */
#ifndef FROE_FORMATS_MAKER_H
#define FROE_FORMATS_MAKER_H

#include "formats/input/sink.h"

typedef struct formats_maker {
    formats_sink sink;
    size_t n; /**< objects wanted */
    uint64_t seed, counter;
    froe_status status;
} formats_maker;

typedef void formats_make_fn(formats_maker *maker);

/** Enough objects, or failed. */
bool formats_done(const formats_maker *maker);

/** The next number in [0, 1), a multiple of 2^-53. */
double formats_unit(formats_maker *maker);
/** A random point of the unit cube. */
void formats_place(formats_maker *maker, int dim, double *to);
double formats_between(formats_maker *maker, double lo, double hi);
/** The next whole number in 0 .. n-1, n < 2^32. */
uint32_t formats_below(formats_maker *maker, uint32_t n);
/** A number in [0, 1) that depends on a place, not on the order of calls. */
double formats_unit_at(const formats_maker *maker, uint64_t layer, uint64_t i, uint64_t j);
/** A unit vector, about evenly distributed. */
void formats_direction(formats_maker *maker, int dim, double *to);
/** Point i of g on the unit circle, counterclockwise from (1, 0). */
void formats_circle(size_t i, size_t g, double *to);
/** Place i of a grid with `side` places a row (and rows a storey): its digits to that base. */
void formats_grid(size_t i, size_t side, int dim, double *to);
/** floor(n^(1/d)), d = 2 or 3. */
size_t formats_root(size_t n, int d);
/** The cube root, by Newton's iteration. */
double formats_cube_root(double x);

void formats_make_segment(formats_maker *maker, double ax, double ay, double bx, double by);
void formats_make_triangle(formats_maker *maker, const double *a, const double *b, const double *c);
/** A parallelogram or trapezium as two triangles of one face. */
void formats_make_quad(formats_maker *maker, const double *a, const double *b, const double *c, const double *d);
/** The surface of a box: 12 triangles, seen anticlockwise from outside. */
void formats_make_cuboid(formats_maker *maker, const double *lo, const double *hi);
/** Objects to come belong to a new group, named by a word and a number. */
void formats_make_group(formats_maker *maker, const char *word, size_t number, const char *material);

/* the kinds, by file */
formats_make_fn formats_make_points, formats_make_boxes, formats_make_balls, formats_make_needles,
    formats_make_simplices, formats_make_hulls; /* make_simple.c */
formats_make_fn formats_make_rows, formats_make_sticks, formats_make_slabs, formats_make_towers,
    formats_make_panels; /* make_boxes.c */
formats_make_fn formats_make_shells, formats_make_bars, formats_make_plates, formats_make_moons, formats_make_bricks,
    formats_make_debris; /* make_boxes.c */
formats_make_fn formats_make_segments, formats_make_disjoint, formats_make_mixed,
    formats_make_clusters; /* make_plane.c */
formats_make_fn formats_make_parallel, formats_make_hair, formats_make_slats, formats_make_star,
    formats_make_spiral; /* make_plane.c */
formats_make_fn formats_make_nested, formats_make_wedge, formats_make_lattice, formats_make_tiles,
    formats_make_walls; /* make_exact.c */
formats_make_fn formats_make_identical, formats_make_diagonals, formats_make_border,
    formats_make_collinear;                                                                          /* make_exact.c */
formats_make_fn formats_make_huge, formats_make_denormal, formats_make_degenerate;                   /* make_exact.c */
formats_make_fn formats_make_polylines, formats_make_rooms, formats_make_blocks, formats_make_cells; /* make_maps.c */
formats_make_fn formats_make_triangles, formats_make_disjoint_3d, formats_make_mixed_3d,
    formats_make_clusters_3d; /* make_space.c */
formats_make_fn formats_make_parallel_3d, formats_make_hair_3d, formats_make_slats_3d,
    formats_make_star_3d;                                                        /* make_space.c */
formats_make_fn formats_make_grid_3d, formats_make_cuboids, formats_make_sphere; /* make_space.c */
formats_make_fn formats_make_nested_3d, formats_make_lattice_3d, formats_make_tiles_3d,
    formats_make_walls_3d; /* make_exact_3d.c */
formats_make_fn formats_make_identical_3d, formats_make_coplanar_3d, formats_make_border_3d,
    formats_make_huge_3d;                                             /* make_exact_3d.c */
formats_make_fn formats_make_denormal_3d, formats_make_degenerate_3d; /* make_exact_3d.c */
formats_make_fn formats_make_rooms_3d, formats_make_city, formats_make_terrain,
    formats_make_cells_3d; /* make_models.c */

#endif
