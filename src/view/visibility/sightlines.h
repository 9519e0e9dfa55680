/* sightlines.h: the sightlines of one picture, and the sides of them on which points of the picture lie.
 *
 *     EDGE    through an edge of the surface, or a side of the window; or across the window, from side to side
 *     CUT     where the cut of a node divides a patch
 *     STOP    through the point of an edge or wire that lies in the section, or in the plane of a polygon, across
 *             another line
 *
 * A way is a line with a direction: 2 * line, + 1 for its other side. Corners of the picture are vertices, or the
 * meeting a x b of two ways (geom/eye.h); images of them decide most questions, and exact signs the rest. */
#ifndef FROE_VIEW_VISIBILITY_SIGHTLINES_H
#define FROE_VIEW_VISIBILITY_SIGHTLINES_H
#include "geom/eye.h"
#include "scene/table.h"
#include "tree/tree.h"
#include "view/visibility/surface.h"

typedef uint32_t view_way;

enum { VIEW_EDGE, VIEW_CUT, VIEW_STOP };

typedef struct view_line {
    filter_vector image;
    uint32_t kind;
    uint32_t a, b; /**< EDGE: vertices | CUT: patch, node | STOP: edge or wire, axis */
    uint32_t c;    /**< EDGE: its number, or FROE_NONE | STOP: the polygon; FROE_NONE: the section, which is the cut of
                      the root */
} view_line;

/** An end of a stretch of a line: a vertex, or its meeting with a way. */
typedef struct view_mark {
    uint32_t vertex; /**< FROE_NONE: the meeting  line x way */
    view_way way;
} view_mark;

typedef struct view_sightlines {
    froe_allocator alloc;
    const froe_tree *tree;
    const froe_surface *surface;
    geom_eye eye;
    num_context context;
    double *points; /**< the vertices after those of the scene: corners of the window, ends of the lines across it */
    uint32_t point_count, window_count;
    uint32_t tiles; /**< a power of two: lines divide the window, one of four corners, into tiles x tiles; 1: none do */
    view_way window_ways[FROE_WINDOW_MOST]; /**< along its sides, the inside on their positive sides */
    int8_t *eye_sides;                      /**< per object: side of its plane the eye is on; 2: not known yet */
    uint32_t *of_edge;                      /**< per edge and wire: its line + 1; 0: not made yet */
    ARRAY(view_line) lines;
    scene_table made; /**< CUT lines */
} view_sightlines;

froe_status view_sightlines_new(view_sightlines *sights, const froe_tree *tree, const froe_surface *surface,
                                const geom_eye *eye, const double *window, uint32_t window_count,
                                const froe_allocator *alloc);
void view_sightlines_free(view_sightlines *sights);
/** The same for another thread, with numbers of its own: lines are no more made. To be closed before it is freed.
 * FROE_E_MEMORY. */
froe_status view_sightlines_fork(const view_sightlines *sights, view_sightlines *out);
void view_sightlines_close(view_sightlines *fork);
/** Keeps, in their order, the lines that `numbers` has something for, and those of the window; `numbers` receives what
 * they are called then. Another one is made anew when it is asked for. FROE_E_MEMORY: the table is lost. */
froe_status view_sightlines_keep(view_sightlines *sights, uint32_t *numbers);
/** Frees the lines, where only points and sides of objects are still asked for. */
void view_sightlines_drop(view_sightlines *sights);

static inline const double *view_vertex(const view_sightlines *s, uint32_t vertex) {
    const uint32_t own = s->tree->scene->vertex_count;
    return vertex < own ? scene_vertex(s->tree->scene, vertex) : s->points + 3 * (size_t)(vertex - own);
}
/** The image of its ray. It is made where it is needed: to keep those of all vertices takes 40 bytes each. */
static inline filter_vector view_ray(const view_sightlines *s, uint32_t vertex) {
    return geom_ray_image(&s->eye, view_vertex(s, vertex));
}
/** Side of an object's plane on which the eye is; exact. */
int view_facing(view_sightlines *sights, uint32_t object);

/** Each gives the line that there is, or makes it; FROE_NONE without memory. */
uint32_t view_line_of_edge(view_sightlines *sights, uint32_t edge);
uint32_t view_line_of_window(view_sightlines *sights, uint32_t side);
/** The lines across the window: from its first side to the third at shares i / tiles of them (axis 0), and from the
 * fourth to the second (axis 1); i from 1 on. */
uint32_t view_line_across(view_sightlines *sights, int axis, uint32_t i);
uint32_t view_line_of_cut(view_sightlines *sights, uint32_t patch, uint32_t node);
/** Does the cut of a node go through a vertex of the scene, by what the cut is made of? False says nothing. */
bool view_cut_has(const view_sightlines *sights, uint32_t node, uint32_t vertex);
/** The plane of an object, or (FROE_NONE) that of the section, the root's cut. */
geom_plane view_plane_at(const view_sightlines *sights, uint32_t object);
/** Where such a plane, which parts its vertices, stops an edge: the mark of that point on a line through it.
 * FROE_E_MEMORY. */
froe_status view_stop_edge(view_sightlines *sights, uint32_t edge, uint32_t object, uint32_t line, view_mark *out);
/** What is the same for equal lines, whatever their directions, and hardly ever for others; *turned: a line of the
 * opposite direction has the same. False: an edge that the eye sees as a point makes no line. */
bool view_line_key(view_sightlines *sights, uint32_t line, double key[3], bool *turned);
/** Orders lines of equal keys: 0: they are equal. Exact. */
int view_compare_lines(view_sightlines *sights, uint32_t a, uint32_t b, const double key[3]);
/** The same for CUT lines of one node as lines of space, whatever the eye: where it lies in the cut, it sees them all
 * as one. */
void view_cut_key(view_sightlines *sights, uint32_t line, double key[3]);
int view_compare_cuts(view_sightlines *sights, uint32_t a, uint32_t b, const double key[3]);
/** Does the eye see an edge as a point? Exact. */
bool view_is_point(view_sightlines *sights, uint32_t edge);

static inline filter_vector view_way_image(const view_sightlines *s, view_way way) {
    filter_vector n = s->lines.data[way >> 1].image;
    for (int k = 0; k < 3 && way & 1; k++) n.x[k] = -n.x[k];
    return n;
}
/** The image of a meeting from exact numbers, for those that are too coarse for a filter. */
filter_vector view_meeting_round(view_sightlines *sights, view_way a, view_way b);
#define VIEW_COARSE 0x1p-32 /**< relative error of an image above which it is made anew */
static inline filter_vector view_meeting(view_sightlines *s, view_way a, view_way b) {
    const filter_vector n_a = view_way_image(s, a), n_b = view_way_image(s, b), ray = filter_cross(&n_a, &n_b);
    return filter_is_fine(&ray, VIEW_COARSE) ? ray : view_meeting_round(s, a, b);
}

/** The side when the image does not decide it. */
int view_side_exactly(view_sightlines *sights, uint32_t line, uint32_t vertex, view_way a, view_way b);
/** Side of a line on which a point with that image is: the vertex, or (FROE_NONE) the meeting of a and b. */
static inline int view_side(view_sightlines *s, uint32_t line, const filter_vector *ray, uint32_t vertex, view_way a,
                            view_way b) {
    const int sure = geom_line_image_side(&s->lines.data[line].image, ray);
    s->context.stats.filtered += sure != NUM_UNSURE;
    return sure != NUM_UNSURE ? sure : view_side_exactly(s, line, vertex, a, b);
}

static inline int view_side_of_vertex(view_sightlines *s, uint32_t line, uint32_t vertex) {
    const filter_vector ray = view_ray(s, vertex);
    return view_side(s, line, &ray, vertex, 0, 0);
}

/** Compares two vertices on a line: -1 the first comes first. Exact. */
int view_compare_vertices(view_sightlines *sights, uint32_t line, uint32_t u, uint32_t v);
/** Where a line meets the segment from vertex u (0) to vertex v (1), rounded. */
double view_share_round(view_sightlines *sights, uint32_t line, uint32_t u, uint32_t v);
/** The plane of a polygon, its normal to a largest component of 1/2 .. 1: products with coordinates do not overflow. */
geom_plane view_support(const froe_scene *scene, uint32_t object);
/** The plane of a patch, and that of the cut of a node, in the same way. */
geom_plane view_plane_of(const view_sightlines *sights, uint32_t patch);
geom_plane view_plane_of_cut(const view_sightlines *sights, uint32_t node);
/** The point of such a plane that is seen along a ray, in doubles. */
void view_point_on(const view_sightlines *sights, const geom_plane *plane, const double ray[3], double out[3]);
/** The way to that point from an eye at a point: it has digits where a point near an eye far away has none. */
void view_way_on(const view_sightlines *sights, const geom_plane *plane, const double ray[3], double out[3]);
/** The point of the line in which two planes meet: by b where a is seen much more edge-on. */
void view_point_on_both(const view_sightlines *sights, const geom_plane *a, const geom_plane *b, const double ray[3],
                        double out[3]);
#endif
