/* render_options.h: what is said on the command line of froe render, as options of a picture. */
#ifndef FROE_CLI_RENDER_OPTIONS_H
#define FROE_CLI_RENDER_OPTIONS_H
#include "args/output.h"
#include "args/tree.h"
#include "command.h"
#include "commands/render_lines.h"
#include "motion/moving.h"
#include <froe/draw.h>

/** Indices into the lists of names in render.c, where no other type says so. */
typedef struct render_args {
    cli_common common;
    cli_tree_args tree;
    cli_output output;
    cli_moving_args moving; /**< its path is that of the tree's scene */
    double at;              /**< NaN: not given */
    uint64_t frames;        /**< 0: not given */
    const char *lines, *background, *title, *description, *opacity, *priority, *size, *shading, *scale;
    char *line_style;
    int direction, up_axis; /**< -1: not given */
    int paint, preset, seams, ids, layers, hidden, colours, over;
    double halo, fov, unit, min_area, seconds, margin, crease, pixels; /**< NaN: not given */
    double seam_width, line_width, point_width;                        /**< the same */
    uint64_t decimals;                                                 /**< UINT64_MAX: not given */
    uint64_t turntable;                                                /**< frames; 0: none */
    cli_reals eye, target, section;
    bool parallel, cull_back, animate, exact;
} render_args;

/** --preset */
enum { ILLUSTRATION, TECHNICAL, PLOTTER, WEB, PRINT };

/** Sets all options that are not about groups, preset first. `styles`, empty, has to live as long as the options.
 * Returns 0 or an exit code, with a message. */
int render_set_options(const render_args *args, const froe_scene *scene, froe_render_options *o, render_styles *styles);
/** NAME=VALUE,... as given to --OPTION: the value goes to every group of that name or material; `values` has one for
 * each group. list NULL: nothing is done. Returns 0 or an exit code, with a message. */
int render_set_groups(const char *option, const char *list, const froe_scene *scene, double *values);

/** All options, with the arrays that they point to. */
typedef struct render_prepared {
    froe_render_options options;
    render_styles styles;
    double *values;
    int32_t *priorities;
} render_prepared;
/** Returns 0 or an exit code, with a message; render_release() must follow. */
int render_prepare(const render_args *args, const froe_scene *scene, render_prepared *out);
void render_release(render_prepared *prepared);
#endif
