/* outline.h: whole patches as rings on the page, and the underlap that hides seams.
 *
 *        c  later patch B          Two antialiased shapes that share an edge let the background shine through. So the
 *       / \                        patch painted first, A, is drawn a little further: over ab into B's polygon abc. The
 *      /.-.\                       addition lies within B, which is painted over it, or under faces painted over B
 *     a-----b                      anyway: where X is seen in front of B, X comes after B, hence after A.
 *      earlier patch A
 */
#ifndef FROE_VIEW_PICTURE_OUTLINE_H
#define FROE_VIEW_PICTURE_OUTLINE_H
#include "view/picture/seams.h"

typedef struct outline_side {
    uint32_t edge, to; /**< vertex where it ends */
    uint32_t object;   /**< of the patch */
    uint32_t next;     /**< side that begins at the same vertex; FROE_NONE */
} outline_side;

/** The points of a ring between the ends of a side: none, one or two. */
typedef struct outline_detour {
    uint32_t count;
    print_point at[2];
} outline_detour;

/** The state that the outlines of all patches share. */
typedef struct view_outliner {
    froe_allocator alloc;
    view_sightlines *sights;
    const froe_projection *view;
    bool cull_back;
    double underlap;      /**< width on the page; 0: none */
    const uint32_t *runs; /**< per patch: patches of one run share a path; of different runs the lower is painted first;
                               FROE_NONE: not painted whole */
    view_seams *seams;    /**< NULL: nothing more is done about seams than underlap */
    uint32_t node;        /**< of the patch */
    print_press press;
    ARRAY(outline_side) sides;
    ARRAY(uint32_t) starts; /**< first vertex of each side */
    uint32_t *first_side;   /**< per vertex: FROE_NONE between calls */
    ARRAY(uint32_t) ring;   /**< sides of the ring in the making */
    ARRAY(outline_detour) detours;
} view_outliner;

froe_status view_outliner_new(view_outliner *outliner, view_sightlines *sights, const froe_projection *view,
                              bool cull_back);
void view_outliner_free(view_outliner *outliner);
/** Appends the rings of a whole patch, outer ones turning left as the eye sees them: their points, and after each ring
 * the number of points so far. False without memory. */
bool view_outline(view_outliner *outliner, uint32_t patch, print_ring *points, print_ends *ends);
#endif
