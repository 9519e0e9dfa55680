/* library.h: froe-io and froe-draw. The program opens them when a command needs them, because GDAL, assimp and Cairo
 * take longer to load than most commands take. Where the program is linked with everything they are there already. */
#ifndef FROE_CLI_LIBRARY_H
#define FROE_CLI_LIBRARY_H
#include <froe/draw.h>
#include <froe/io.h>

typedef struct cli_io {
    __typeof__(froe_read) *read;
    __typeof__(froe_export_map) *export_map;
    __typeof__(froe_render_dxf) *render_dxf;
    __typeof__(froe_read_animation) *read_animation;
} cli_io;

typedef struct cli_draw {
    __typeof__(froe_draw_defaults_into) *defaults;
    __typeof__(froe_draw) *draw;
    __typeof__(froe_draw_write) *write;
    __typeof__(froe_draw_format_of) *format_of;
    __typeof__(froe_draw_layer_name) *layer_name;
    __typeof__(froe_render_png) *render_png;
} cli_draw;

/** Fill in the functions. They return 0, or CLI_RESOURCES after saying that the library is missing, and why. */
int cli_open_io(cli_io *out);
int cli_open_draw(cli_draw *out);
#endif
