/* picture.h: scenes and cells as pictures that fit into a page. */
#ifndef FROE_CLI_COMPARE_PICTURE_H
#define FROE_CLI_COMPARE_PICTURE_H
#include <froe/froe.h>
#include <jansson.h>

/** The objects of a tree, with cells if asked for, as a PNG in base64; null for trees that cannot be drawn (above three
 * dimensions), NULL without memory. */
json_t *picture_json(const froe_tree *tree, bool cells);
/** The same of the objects alone. */
json_t *picture_scene_json(froe_scene *scene);
#endif
