/* build_shards.h: froe build --shards, a folder of trees from a file of any size. */
#ifndef FROE_CLI_BUILD_SHARDS_H
#define FROE_CLI_BUILD_SHARDS_H
#include "args/output.h"
#include "args/scene.h"
#include <froe/shards.h>

typedef struct cli_shards_args {
    const char *shards, *memory; /**< as they are given; NULL: not */
} cli_shards_args;
extern const cli_option cli_shards_options[];

/** Builds the folder `output` of a scene, by the method and other settings of `options`. Returns an exit code. */
int cli_build_shards(const cli_common *common, const cli_scene_args *scene, const cli_shards_args *args,
                     const cli_output *output, froe_shards_options options);
#endif
