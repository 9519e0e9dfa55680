/* ray.h: where does a ray meet a body first? Decided exactly; parameters compared exactly, rounded once, for output.
 *
 * The ray is  o + t d,  t >= 0, in any dimension. A parameter is kept as what it comes from, with a certified image:
 *
 *     START        0: the origin is in the body
 *     COORDINATE   (c - o_k) / d_k                                            degree 1 / 1
 *     LINE         2D cross products, (p - o) x e / d x e  with  e = q - p    degree 2 / 2
 *     PLANE        n (p - o) / n d                                            degree 3 / 3
 *     SPHERE       (-b - sqrt(b^2 - a c)) / a,  a = d^2, b = d (o - m), c = (o - m)^2 - r^2
 *     BASIS        above dimension 3: up to dim corners span what is met      degree dim / dim
 *
 * In ray.c; hulls, and what lies in one plane with the ray, in ray_hull.c; above dimension 3 in geom/high/ray.c; points
 * and normals in ray_place.c. */
#ifndef FROE_GEOM_RAY_RAY_H
#define FROE_GEOM_RAY_RAY_H
#include "geom/body.h"
#include "num/root.h"

typedef struct geom_ray {
    int dim;
    double o[FROE_MAX_DIM], d[FROE_MAX_DIM]; /**< origin; direction, not 0 */
} geom_ray;

typedef enum geom_source { GEOM_START, GEOM_COORDINATE, GEOM_LINE, GEOM_PLANE, GEOM_SPHERE, GEOM_BASIS } geom_source;

/** A parameter t >= 0. */
typedef struct geom_hit {
    geom_source source;
    int count; /**< BASIS: corners */
    union {
        struct {
            int axis, other;     /**< COORDINATE: k; LINE: the two axes it is seen in */
            double c;            /**< COORDINATE: c; SPHERE: the radius */
            const double *q, *r; /**< more corners of the body */
        };
        uint32_t basis[FROE_MAX_DIM]; /**< BASIS: the corners are p[basis[i] * dim ..] */
    };
    const double *p; /**< a corner; SPHERE: the centre; BASIS: all points */
    num_ball t;      /**< image: infinite error where nothing is known */
} geom_hit;

/** False: it does not. Keeps pointers to the body's points. */
bool geom_ray_meets(num_context *context, const geom_ray *ray, const geom_body *body, geom_hit *first);
/** Where a ray meets a polygon of space that it is known to pass through, in one inner point; without an image. */
geom_hit geom_ray_through(const geom_body *body);
/** Sign of a - b. */
int geom_hit_compare(num_context *context, const geom_ray *ray, const geom_hit *a, const geom_hit *b);
/** Sign of a - t, t >= 0 or infinite. */
int geom_hit_compare_to(num_context *context, const geom_ray *ray, const geom_hit *a, double t);
/** The nearest double. */
double geom_hit_round(num_context *context, const geom_ray *ray, const geom_hit *a);
/** The parameter as a number, behind what the arena holds. */
num_surd geom_hit_surd(num_arena *arena, const geom_ray *ray, const geom_hit *a);

/** The point that is hit: dim coordinates, each the nearest double. */
void geom_hit_point(num_context *context, const geom_ray *ray, const geom_hit *a, double *out);
/** How far it is from the origin: the nearest double. */
double geom_hit_distance(num_context *context, const geom_ray *ray, const geom_hit *a);
/** The normal of the face that is hit, of length 1, each coordinate the nearest double, as froe_hit_place says in
 * froe/query.h. False, and all 0: there is none. */
bool geom_hit_normal(num_context *context, const geom_ray *ray, const geom_body *body, const geom_hit *a, double *out);

/** The same as geom_ray_meets() for hulls, and for flat bodies in the plane of the ray: corners in any order,
 * dimension 2 or 3. Called by it. */
bool geom_ray_meets_hull(num_context *context, const geom_ray *ray, const geom_body *body, geom_hit *first);
/** Fills the image of a hit. */
void geom_hit_image(num_context *context, const geom_ray *ray, geom_hit *hit);
/** Sign of the parameter, whatever it is. */
int geom_hit_sign(num_context *context, const geom_ray *ray, const geom_hit *hit);
#endif
