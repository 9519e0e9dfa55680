/* space.h: the scene in drawing coordinates, about -1 .. 1, and cuts in them.
 *
 * A scene may span 1e308 or a few denormals; neither survives differences and
 * products of raw coordinates. Everything is first multiplied by a power of two
 * (exact but for underflow) that brings the window near 1. Results are always finite.
 * Drawing axes are x to the right, y away from the viewer, z up: a scene whose models
 * stand along another axis is turned. */
#ifndef FROE_DRAW_SPACE_H
#define FROE_DRAW_SPACE_H
#include <froe/froe.h>

typedef struct draw_space {
    int dim;
    int from[3];     /**< the scene's axis that becomes each drawing axis */
    double sign[3];  /**< and which way round: 1 or -1 */
    int shift;       /**< coordinates are taken times 2^shift */
    double mid[3];   /**< of the window, times 2^shift, by drawing axis, its sign applied */
    double half;     /**< largest half extent of the window, times 2^shift; > 0 */
    double reach[3]; /**< half extents in drawing coordinates, <= 1; 0: flat in this axis */
    double squeeze;  /**< what lengths along the first axis are multiplied by on the page; 1 but on maps in degrees */
    double unit;     /**< scene length of drawing length 1: may round to infinity or 0 */
} draw_space;

/** up: the scene's axis that points up (3D). */
draw_space draw_space_over(int dim, int up, const double *lo, const double *hi);
/** The drawing axis that a scene's axis becomes. */
int draw_space_axis(const draw_space *space, int scene_axis);
/** A coordinate of the scene's axis behind drawing axis k as a drawing coordinate, clamped to
 * +-1e100. */
double draw_space_map(const draw_space *space, int k, double x);
/** dim coordinates; the third is 0 in the plane. */
void draw_space_point(const draw_space *space, const double *x, double *out);

/** side(p) = sign of n . p - c, where n has largest component 1, or is 0 where
 * even scaled doubles cannot tell a direction: then everything lies on side 1. */
typedef struct draw_plane {
    double n[3], c;
} draw_plane;
draw_plane draw_space_plane(const draw_space *space, const froe_scene *scene, const froe_cut *cut);
#endif
