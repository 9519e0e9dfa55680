/* generate.c: froe_generate: the list of kinds, one line each. */
#include "formats/generate/maker.h"
#include "support/floats.h"
#include <string.h>

typedef struct scene_generator {
    froe_generator_info info;
    formats_make_fn *make;
} scene_generator;

static const scene_generator generators[] = {
    /* in the plane */
    {{"segments", 2, FROE_SEGMENT, "short segments anywhere in the unit square; some cross", true},
     formats_make_segments},
    {{"disjoint", 2, FROE_SEGMENT, "short segments, one in each cell of a grid: no two meet", false},
     formats_make_disjoint},
    {{"mixed", 2, FROE_SEGMENT, "lengths by a power law, from short to the whole square", false}, formats_make_mixed},
    {{"clusters", 2, FROE_SEGMENT, "short segments in clusters of very different density", false},
     formats_make_clusters},
    {{"nested", 2, FROE_SEGMENT, "squares around the origin, each half as wide as the one before", false},
     formats_make_nested},
    {{"wedge", 2, FROE_SEGMENT, "segments across a wedge of 45 degrees, down to its tip", false}, formats_make_wedge},
    {{"lattice", 2, FROE_SEGMENT, "edges of a square grid: corners shared by four", false}, formats_make_lattice},
    {{"tiles", 2, FROE_SEGMENT, "squares side by side: every border twice", false}, formats_make_tiles},
    {{"walls", 2, FROE_SEGMENT, "axis-parallel, at dyadic coordinates, where splits fall", false}, formats_make_walls},
    {{"cells", 2, FROE_SEGMENT, "cuts of a random axis-parallel partition: exact T-junctions", false},
     formats_make_cells},
    {{"border", 2, FROE_SEGMENT, "segments on and at the border of the scene", false}, formats_make_border},
    {{"identical", 2, FROE_SEGMENT, "one segment, n times", false}, formats_make_identical},
    {{"collinear", 2, FROE_SEGMENT, "a chain of segments on one oblique line", false}, formats_make_collinear},
    {{"diagonals", 2, FROE_SEGMENT, "segments at 45 degrees between whole coordinates", false}, formats_make_diagonals},
    {{"star", 2, FROE_SEGMENT, "n segments from one point", false}, formats_make_star},
    {{"spiral", 2, FROE_SEGMENT, "one polyline winding outwards", false}, formats_make_spiral},
    {{"parallel", 2, FROE_SEGMENT, "long segments, nearly parallel", false}, formats_make_parallel},
    {{"hair", 2, FROE_SEGMENT, "dense, long, nearly upright segments", false}, formats_make_hair},
    {{"slats", 2, FROE_SEGMENT, "n/2 long segments crossing n/2 others: n^2/4 crossings", false}, formats_make_slats},
    {{"polylines", 2, FROE_SEGMENT, "winding polylines, as on a map", true}, formats_make_polylines},
    {{"rooms", 2, FROE_SEGMENT, "a floor plan: rooms, corridors and doors", true}, formats_make_rooms},
    {{"blocks", 2, FROE_SEGMENT, "a town plan: turned and cornered houses along streets", true}, formats_make_blocks},
    {{"huge", 2, FROE_SEGMENT, "coordinates up to 1e300", false}, formats_make_huge},
    {{"denormal", 2, FROE_SEGMENT, "coordinates below the least normal double", false}, formats_make_denormal},
    {{"degenerate", 2, FROE_SEGMENT, "a tiny lattice: points, duplicates, overlaps, -0.0", false},
     formats_make_degenerate},
    /* in space */
    {{"triangles", 3, FROE_POLYGON, "small triangles anywhere in the unit cube; some meet", true},
     formats_make_triangles},
    {{"disjoint-3d", 3, FROE_POLYGON, "small triangles, one in each cell of a grid: no two meet", false},
     formats_make_disjoint_3d},
    {{"mixed-3d", 3, FROE_POLYGON, "sizes by a power law", false}, formats_make_mixed_3d},
    {{"clusters-3d", 3, FROE_POLYGON, "small triangles in clusters of very different density", false},
     formats_make_clusters_3d},
    {{"nested-3d", 3, FROE_POLYGON, "cubes around the origin, each half as wide as the one before", false},
     formats_make_nested_3d},
    {{"lattice-3d", 3, FROE_POLYGON, "squares of a cubic grid: corners shared by many", false},
     formats_make_lattice_3d},
    {{"tiles-3d", 3, FROE_POLYGON, "cubes side by side: every wall twice", false}, formats_make_tiles_3d},
    {{"walls-3d", 3, FROE_POLYGON, "axis-parallel walls at dyadic coordinates, where splits fall", false},
     formats_make_walls_3d},
    {{"cells-3d", 3, FROE_POLYGON, "walls of a random axis-parallel partition", false}, formats_make_cells_3d},
    {{"border-3d", 3, FROE_POLYGON, "triangles on and at the border of the scene", false}, formats_make_border_3d},
    {{"identical-3d", 3, FROE_POLYGON, "one triangle, n times", false}, formats_make_identical_3d},
    {{"coplanar-3d", 3, FROE_POLYGON, "overlapping triangles of one oblique plane", false}, formats_make_coplanar_3d},
    {{"star-3d", 3, FROE_POLYGON, "triangles around one point", false}, formats_make_star_3d},
    {{"parallel-3d", 3, FROE_POLYGON, "large triangles, nearly parallel", false}, formats_make_parallel_3d},
    {{"hair-3d", 3, FROE_POLYGON, "dense, long, thin, nearly upright triangles", false}, formats_make_hair_3d},
    {{"slats-3d", 3, FROE_POLYGON, "n/2 thin slats crossing n/2 others: n^2/4 intersections", false},
     formats_make_slats_3d},
    {{"grid-3d", 3, FROE_POLYGON, "thin triangles on two hyperbolic paraboloids: every partition is quadratic", false},
     formats_make_grid_3d},
    {{"cuboids", 3, FROE_POLYGON, "boxes of constant density, 12 triangles each", false}, formats_make_cuboids},
    {{"sphere", 3, FROE_POLYGON, "a sphere by meridians and parallels", false}, formats_make_sphere},
    {{"rooms-3d", 3, FROE_POLYGON, "a house: storeys of rooms with doors", true}, formats_make_rooms_3d},
    {{"city", 3, FROE_POLYGON, "blocks of buildings along streets", true}, formats_make_city},
    {{"terrain", 3, FROE_POLYGON, "an irregular network of triangles over hills", true}, formats_make_terrain},
    {{"huge-3d", 3, FROE_POLYGON, "coordinates up to 1e300", false}, formats_make_huge_3d},
    {{"denormal-3d", 3, FROE_POLYGON, "coordinates below the least normal double", false}, formats_make_denormal_3d},
    {{"degenerate-3d", 3, FROE_POLYGON, "a tiny lattice: points, segments, duplicates, -0.0", false},
     formats_make_degenerate_3d},
    /* other objects */
    {{"points", 2, FROE_POINT, "points in the unit square", true}, formats_make_points},
    {{"points-3d", 3, FROE_POINT, "points in the unit cube", false}, formats_make_points},
    {{"points-8d", 8, FROE_POINT, "points in the unit cube of dimension 8", false}, formats_make_points},
    {{"boxes", 2, FROE_BOX, "small rectangles", true}, formats_make_boxes},
    {{"boxes-3d", 3, FROE_BOX, "small boxes", false}, formats_make_boxes},
    {{"rows", 2, FROE_BOX, "cells of a circuit: rows of touching rectangles", false}, formats_make_rows},
    {{"debris", 2, FROE_BOX, "rectangles on a tiny lattice: overlaps, equal ones, none wide or high", false},
     formats_make_debris},
    {{"sticks", 3, FROE_BOX, "disjoint sticks, each along an axis", false}, formats_make_sticks},
    {{"slabs", 3, FROE_BOX, "disjoint slabs, each across an axis", false}, formats_make_slabs},
    {{"towers", 3, FROE_BOX, "towers along streets, standing on the ground", false}, formats_make_towers},
    {{"panels", 3, FROE_BOX, "a building of thick walls and ceilings, which touch", false}, formats_make_panels},
    {{"shells", 3, FROE_BOX, "cubes around the origin, one in the other", false}, formats_make_shells},
    {{"bars", 3, FROE_BOX, "bars in three directions through one cube: n^1.5 for any such partition", false},
     formats_make_bars},
    {{"plates", 3, FROE_BOX, "a stack of wide plates: a cube meets all, no plane of a face crosses another", false},
     formats_make_plates},
    {{"moons", 3, FROE_BOX, "large cubes, each with a crowd of small ones across the planes of its faces", false},
     formats_make_moons},
    {{"bricks", 3, FROE_BOX, "cubes side by side", false}, formats_make_bricks},
    {{"debris-3d", 3, FROE_BOX, "boxes on a tiny lattice: overlaps, equal ones, flat ones", false},
     formats_make_debris},
    {{"debris-5d", 5, FROE_BOX, "the same in dimension 5", false}, formats_make_debris},
    {{"balls", 2, FROE_BALL, "small discs", true}, formats_make_balls},
    {{"balls-3d", 3, FROE_BALL, "small balls", false}, formats_make_balls},
    {{"segments-4d", 4, FROE_SEGMENT, "short segments in the unit cube of dimension 4", false}, formats_make_needles},
    {{"simplices-4d", 4, FROE_HULL, "small simplices in the unit cube of dimension 4", false}, formats_make_simplices},
    {{"hulls-5d", 5, FROE_HULL, "small hulls of six to eleven points in the unit cube of dimension 5", false},
     formats_make_hulls},
};
enum { GENERATORS = sizeof generators / sizeof *generators };

const froe_generator_info *froe_generator_at(size_t i) {
    return i < GENERATORS ? &generators[i].info : NULL;
}

froe_status froe_generate(const char *kind, size_t n, uint64_t seed, const froe_allocator *alloc, froe_scene **out,
                          froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!kind || !out) return support_fail_null(diag, __func__);
    const scene_generator *g = generators, *end = generators + GENERATORS;
    while (g != end && strcmp(g->info.name, kind)) ++g;
    if (g == end) return support_fail(diag, FROE_E_OPTIONS, "There is no kind of scene '%.60s'.", kind);
    if (!n) return support_fail(diag, FROE_E_ARG, "A scene of 0 objects cannot be generated.");
    if (n >= (1u << 31) - 2) return support_fail(diag, FROE_E_LIMIT, "There are more than 2^31 - 3 objects.");
    formats_maker m = {.sink = {.alloc = support_allocator(alloc), .diag = diag, .path = kind, .unit = "object"},
                       .n = n,
                       .seed = seed};
    m.status = formats_sink_open(&m.sink, g->info.dim);
    if (!m.status) g->make(&m);
    if (!m.status) m.status = formats_sink_take(&m.sink, out);
    formats_sink_free(&m.sink);
    return m.status;
}
