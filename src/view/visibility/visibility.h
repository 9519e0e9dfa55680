/* visibility.h: what one eye sees: the internal type.
 *
 * It speaks for visibility.c (pieces front to back, each sent down the beam tree), kept.c (corners and lines of what is
 * visible), intervals.c (visible stretches of an edge), wires.c (segments and points), ranks.c (the order within one
 * plane) and tally.c (counts of what is visible and what is not). */
#ifndef FROE_VIEW_VISIBILITY_VISIBILITY_H
#define FROE_VIEW_VISIBILITY_VISIBILITY_H
#include "base/task.h"
#include "view/visibility/beam.h"

typedef struct view_piece {
    uint32_t patch, object, piece, place;
    uint32_t first, count; /**< its ring in `corners` */
} view_piece;

/** A corner of a visible piece: a view_corner, of which the ray can be had again (view_ray_at). */
typedef struct view_spot {
    view_way way;
    uint32_t vertex; /**< or VIEW_KEPT */
} view_spot;

/** No vertex: a meeting whose ray is kept, as the filter finds another one, or none that is fine. */
#define VIEW_KEPT (FROE_NONE - 1)

typedef struct view_kept_ray {
    uint32_t corner;
    double x[3];
} view_kept_ray;

/** A corner by its number, and the way of the side before it. */
typedef struct view_turn {
    uint32_t corner;
    view_way before;
} view_turn;

/** A part of a line, from mark to mark in its direction. */
typedef struct view_run {
    uint32_t line;
    view_mark end[2];
} view_run;

struct froe_visibility {
    froe_allocator alloc;
    const froe_tree *tree;
    const froe_surface *surface;
    view_sightlines sights;
    int section;        /**< see froe_visibility_options */
    view_piece *pieces; /**< ordered by patch, then place */
    uint32_t piece_count;
    ARRAY(view_spot) corners;
    ARRAY(view_kept_ray) kept_rays; /**< ascending */
    uint32_t *patch_starts;         /**< patch_count + 1, into pieces */
    froe_interval *intervals;
    view_mark *interval_marks; /**< two per interval: where it ends exactly, on the line of its edge */
    uint32_t interval_count;
    size_t interval_room;
    uint32_t *edge_starts; /**< per edge and wire, and 1 more: into intervals */
    uint8_t *points_seen;  /**< per point */
    ARRAY(froe_crossing) crossings;
    ARRAY(view_run) crossing_runs; /**< the same, exactly */
    froe_visibility_report report;
};

typedef ARRAY(view_stretch) view_stretches;
/** Stretches of edges and wires, with the number of these for a line. */
typedef ARRAY(view_run) view_runs;

static inline uint32_t view_vertex_of(const view_spot *spot) {
    return spot->vertex == VIEW_KEPT ? FROE_NONE : spot->vertex;
}
/** Corner i of a visible piece. */
static inline view_turn view_turn_at(const froe_visibility *v, const view_piece *p, uint32_t i) {
    return (view_turn){p->first + i, v->corners.data[p->first + (i ? i : p->count) - 1].way};
}
/** The ray of a corner, as it was found. */
void view_ray_at(const froe_visibility *v, view_turn at, double out[3]);
/** The ring of a visible piece. False without memory. */
bool view_ring_of_visible(const froe_visibility *v, view_sightlines *sights, uint32_t visible, view_ring *out);

/** FROE_E_ARG: it is of another scene. */
froe_status view_check_surface(const froe_tree *tree, const froe_surface *surface, froe_diagnostic *diag);
/** The rank of every object within its plane (see froe_visibility_options), object_count + 1 words; to be
 * freed after a failure, too. FROE_E_MEMORY. */
froe_status view_rank_objects(const froe_allocator *alloc, const froe_surface *surface, const int32_t *priorities,
                              uint32_t **ranks);
/** The place of every piece of the tree, front to back, as in froe_visible. FROE_E_MEMORY. */
froe_status view_find_places(const froe_visibility *v, const int32_t *priorities, uint32_t *places);
/** Appends a corner of a visible piece, for which there is room. False without memory. */
bool view_keep_corner(froe_visibility *v, const view_corner *corner, view_way before);
/** Frees the lines on which nothing visible ends. FROE_E_MEMORY. */
froe_status view_keep_lines(froe_visibility *v);
/** Counts, for the report, what is visible and what is not, and why. */
void view_tally(froe_visibility *v, bool cull_back);
/** A whole edge or wire, as far as it lies in the window and is not cut away. *there: something is left, and the eye
 * does not see it as a point. FROE_E_MEMORY. */
froe_status view_rest_of_edge(froe_visibility *v, uint32_t edge, view_stretch *out, bool *there);
/** Joins the visible stretches of each edge and wire to intervals. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status view_join_intervals(froe_visibility *v, const view_runs *stretches);
/** Frees the visible pieces, and the lines, of a visibility that is not asked for them any more. */
void view_drop_pieces(froe_visibility *v);
/** The same for its intervals. */
void view_drop_intervals(froe_visibility *v);
/** The end of a stretch of a line at a mark. */
view_end view_end_at(view_sightlines *sights, uint32_t line, view_mark mark);
/** Compares two meetings, or a vertex with a meeting, along a line of sight: -1 the first comes first. Exact. */
int view_compare_along(view_sightlines *sights, uint32_t line, const view_end *a, const view_end *b);
/** The same for any two ends. */
int view_compare_ends(view_sightlines *sights, uint32_t line, const view_end *a, const view_end *b);
/** Where an end lies on an edge, as its share from the lower vertex (0) to the higher (1), rounded. */
double view_share_of(view_sightlines *sights, uint32_t edge, view_mark mark);
#endif
