/* convex.h: the objects of a scene as convex sets. */
#ifndef FROE_SCENE_CONVEX_H
#define FROE_SCENE_CONVEX_H
#include "geom/convex.h"
#include "scene/scene.h"

/** An object of the plane or of space. Its coordinates stay the scene's. */
static inline geom_convex scene_convex(const froe_scene *s, uint32_t object) {
    const geom_body body = scene_body(s, object);
    return geom_convex_of(&body);
}
#endif
