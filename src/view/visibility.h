/* visibility.h: what one eye sees, from inside. */
#ifndef FROE_VIEW_VISIBILITY_H
#define FROE_VIEW_VISIBILITY_H
#include "base/task.h"
#include "view/beam.h"

typedef struct view_piece {
    uint32_t patch, object, piece, place;
    uint32_t first, count; /**< its ring in `corners` */
} view_piece;

struct froe_visibility {
    froe_allocator alloc;
    const froe_tree *tree;
    const froe_surface *surface;
    view_sights sights;
    int section;        /**< see froe_visibility_options */
    view_piece *pieces; /**< ordered by patch, then place */
    uint32_t piece_count;
    ARRAY(view_corner) corners;
    uint32_t *patch_starts; /**< patch_count + 1, into pieces */
    froe_interval *intervals;
    uint32_t interval_count;
    size_t interval_room;
    uint32_t *edge_starts; /**< edge_count + 1, into intervals */
    ARRAY(froe_crossing) crossings;
    froe_visibility_report report;
};

typedef ARRAY(view_stretch) view_stretches;

/** The rank of every object within its plane (see froe_visibility_options), object_count + 1 words; also without
 * success to be freed. FROE_E_MEMORY. */
froe_status view_rank_objects(const froe_allocator *alloc, const froe_surface *surface, const int32_t *priorities,
                              uint32_t **ranks);
/** The place of every piece of the tree, front to back, as in froe_visible. FROE_E_MEMORY. */
froe_status view_find_places(const froe_visibility *v, const int32_t *priorities, uint32_t *places);
/** Joins the visible stretches of each edge to intervals. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status view_join_intervals(froe_visibility *v, const view_stretches *stretches);
/** Compares two meetings of a line of sight with others along it: -1 the first comes first. Exact. */
int view_compare_along(view_sights *sights, uint32_t line, const view_end *a, const view_end *b);
/** Where the end of a stretch lies on its edge, compared with another: -1 nearer to the lower vertex. Exact. */
int view_compare_ends(view_sights *sights, uint32_t edge, const view_end *a, const view_end *b);
#endif
