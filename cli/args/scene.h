/* scene.h: reading the SCENE of a command line; shared by all commands that take one. */
#ifndef FROE_CLI_SCENE_H
#define FROE_CLI_SCENE_H
#include "args/options.h"
#include <froe/froe.h>
#include <froe/io.h>

typedef struct cli_scene_args {
    const char *path, *format, *layer, *where;
    int faces; /**< -1: not given */
    bool boxes, wrap;
    const froe_allocator *alloc; /**< of the scene; NULL: malloc */
} cli_scene_args;
extern const cli_option cli_scene_options[]; /**< the first is SCENE itself */
/** What SCENE may be, for the `about` of a command. */
#define CLI_SCENE_ABOUT                                                                                                \
    "SCENE is a file of one of three kinds. Maps: all formats that OGR reads (GeoJSON, TopoJSON, Shapefile, "          \
    "GeoPackage, FlatGeobuf, DXF, ...), also in a folder or an archive (.zip, .gz, .tar). Models: all formats that "   \
    "assimp reads (glTF, OBJ, STL, PLY, OFF, IFC, FBX, ...). CSV: points (x,y[,z...]), boxes "                         \
    "(lo_x,lo_y[,...],hi_x,...) or balls (x,y[,...],r)."

/** Says on stderr, unless --quiet, when edges of a scene run the wrong way around the Earth. */
void cli_warn_scene(const cli_common *common, const char *path, const froe_scene *scene);
/** Reads the scene with a progress bar. Says on stderr, unless --quiet, when its format promises degrees that it does
 * not have, and what cli_warn_scene() has to say. Returns 0, or an exit code after saying why. */
int cli_read_scene(const cli_common *common, const cli_scene_args *args, froe_scene **scene, froe_read_report *report);
#endif
