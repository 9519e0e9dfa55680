/* convex.h: the objects of a scene as convex sets. */
#ifndef FROE_SCENE_CONVEX_H
#define FROE_SCENE_CONVEX_H
#include "geom/convex.h"
#include "scene/scene.h"

/** An object of the plane or of space. Its coordinates stay the scene's. */
static inline geom_convex scene_convex(const froe_scene *s, uint32_t object) {
    geom_convex c = {.dim = s->dim, .coords = s->coords, .ids = s->corners + s->starts[object]};
    c.count = scene_corners(s, object);
    if (scene_form(s, object) == FROE_BALL) c.count = 1, c.radius = scene_radius(s, object);
    if (scene_form(s, object) == FROE_BOX) c.core = GEOM_CORE_BOX, c.count = 1u << s->dim;
    return c;
}
#endif
