/* scene.h: scenes. */
#ifndef FROE_CORE_SCENE_H
#define FROE_CORE_SCENE_H
#include "core.h"

/** A scene that has just been made, which the object takes. NULL: an exception is set, and the scene is freed. */
PyObject *core_scene_object(froe_scene *scene);
#endif
