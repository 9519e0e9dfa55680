/* film.h: pictures of a moving model, for froe render. */
#ifndef FROE_CLI_MOTION_FILM_H
#define FROE_CLI_MOTION_FILM_H
#include "commands/render_options.h"

/** Is a moving model asked for, by an option or by the ending of the file? */
bool cli_is_moving(const render_args *args);
/** Draws it: at an instant, frame by frame, or as one SVG that plays. Returns an exit code. */
int cli_render_moving(const render_args *args);
/** The film of a model at rest around which the eye goes, exactly. Returns an exit code. */
int cli_render_around(const render_args *args, const froe_scene *scene);
#endif
