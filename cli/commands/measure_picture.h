/* measure_picture.h: the cube or ball in which a measure is greatest, among the objects around it. */
#ifndef FROE_CLI_MEASURE_PICTURE_H
#define FROE_CLI_MEASURE_PICTURE_H
#include "args/options.h"
#include <froe/measure.h>

/** Before anything is measured: can pictures be drawn, and to files of these names? Names may be NULL. Returns 0 or an
 * exit code. */
int measure_check_pictures(const char *const *paths, size_t count);
/** Does the scene of the file `path` have pictures? Returns 0 or an exit code. */
int measure_check_dimension(const char *path, const froe_scene *scene);

/** Draws a scene of two or three dimensions around a cube to a file, as `froe draw` does. Builds at most so
 * many pieces for it, or cli_budget(). Returns 0 or an exit code. */
int measure_draw_cube(const cli_common *common, const char *path, froe_scene *scene, const froe_clutter *clutter,
                      uint64_t max_fragments);
/** The same around a ball. */
int measure_draw_ball(const cli_common *common, const char *path, froe_scene *scene, const froe_density *density,
                      uint64_t max_fragments);
#endif
