/* maker.h: what the generators of scenes share.
 *
 * Coordinates come from + - * / sqrt and an integer hash alone: no trigonometry, no
 * logarithm, nothing that differs between mathematical libraries. Directions are
 * rational points of the unit circle, ((1-t^2)/(1+t^2), 2t/(1+t^2)). Failures stick:
 * after the first nothing more is added. One expression asks for at most one random
 * number, for C leaves the order of calls within an expression to the compiler. */
#ifndef FROE_IO_MAKER_H
#define FROE_IO_MAKER_H

#include "sink.h"

typedef struct io_maker {
    io_sink sink;
    size_t n; /**< objects wanted */
    uint64_t seed, counter;
    froe_status status;
} io_maker;

typedef void io_make_fn(io_maker *maker);

/** Enough objects, or failed. */
bool io_done(const io_maker *maker);

/** The next number in [0, 1), a multiple of 2^-53. */
double io_unit(io_maker *maker);
/** A random point of the unit cube. */
void io_place(io_maker *maker, int dim, double *to);
double io_between(io_maker *maker, double lo, double hi);
/** The next whole number in 0 .. n-1, n < 2^32. */
uint32_t io_below(io_maker *maker, uint32_t n);
/** A number in [0, 1) that depends on a place, not on the order of calls. */
double io_unit_at(const io_maker *maker, uint64_t layer, uint64_t i, uint64_t j);
/** A unit vector, about evenly distributed. */
void io_direction(io_maker *maker, int dim, double *to);
/** Point i of g on the unit circle, counterclockwise from (1, 0). */
void io_circle(size_t i, size_t g, double *to);
/** Place i of a grid with `side` places a row (and rows a storey): its digits to that base. */
void io_grid(size_t i, size_t side, int dim, double *to);
/** floor(n^(1/d)), d = 2 or 3. */
size_t io_root(size_t n, int d);
/** The cube root, by Newton's iteration. */
double io_cube_root(double x);

void io_make_segment(io_maker *maker, double ax, double ay, double bx, double by);
void io_make_triangle(io_maker *maker, const double *a, const double *b, const double *c);
/** A parallelogram or trapezium as two triangles of one face. */
void io_make_quad(io_maker *maker, const double *a, const double *b, const double *c, const double *d);
/** The surface of a box: 12 triangles, seen anticlockwise from outside. */
void io_make_cuboid(io_maker *maker, const double *lo, const double *hi);
/** Objects to come belong to a new group, named by a word and a number. */
void io_make_group(io_maker *maker, const char *word, size_t number, const char *material);

/* the kinds, by file */
io_make_fn io_make_points, io_make_boxes, io_make_balls;                                /* make_simple.c */
io_make_fn io_make_rows, io_make_sticks, io_make_slabs, io_make_towers, io_make_panels; /* make_boxes.c */
io_make_fn io_make_shells, io_make_bars, io_make_plates, io_make_moons, io_make_bricks,
    io_make_debris;                                                                       /* make_boxes.c */
io_make_fn io_make_segments, io_make_disjoint, io_make_mixed, io_make_clusters;           /* make_plane.c */
io_make_fn io_make_parallel, io_make_hair, io_make_slats, io_make_star, io_make_spiral;   /* make_plane.c */
io_make_fn io_make_nested, io_make_wedge, io_make_lattice, io_make_tiles, io_make_walls;  /* make_exact.c */
io_make_fn io_make_identical, io_make_diagonals, io_make_border, io_make_collinear;       /* make_exact.c */
io_make_fn io_make_huge, io_make_denormal, io_make_degenerate;                            /* make_exact.c */
io_make_fn io_make_polylines, io_make_rooms, io_make_blocks, io_make_cells;               /* make_maps.c */
io_make_fn io_make_triangles, io_make_disjoint_3d, io_make_mixed_3d, io_make_clusters_3d; /* make_space.c */
io_make_fn io_make_parallel_3d, io_make_hair_3d, io_make_slats_3d, io_make_star_3d;       /* make_space.c */
io_make_fn io_make_grid_3d, io_make_cuboids, io_make_sphere;                              /* make_space.c */
io_make_fn io_make_nested_3d, io_make_lattice_3d, io_make_tiles_3d, io_make_walls_3d;     /* make_exact_3d.c */
io_make_fn io_make_identical_3d, io_make_coplanar_3d, io_make_border_3d, io_make_huge_3d; /* make_exact_3d.c */
io_make_fn io_make_denormal_3d, io_make_degenerate_3d;                                    /* make_exact_3d.c */
io_make_fn io_make_rooms_3d, io_make_city, io_make_terrain, io_make_cells_3d;             /* make_models.c */

#endif
