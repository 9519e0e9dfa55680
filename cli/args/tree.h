/* tree.h: the SCENE of commands that work on a tree: a scene, for which a tree is built, or a saved tree. */
#ifndef FROE_CLI_TREE_H
#define FROE_CLI_TREE_H
#include "args/budget.h"
#include "args/scene.h"
#include <froe/shards.h>

typedef struct cli_tree_args {
    cli_scene_args scene; /**< faces: -1 when not given */
    const char *method;   /**< NULL when not given */
    const char *save;
    uint64_t max_fragments;
} cli_tree_args;
#define CLI_TREE_DEFAULTS                                                                                              \
    { .scene.faces = -1, .max_fragments = CLI_BUDGET_OWN }

extern const cli_option cli_tree_options[]; /**< SCENE itself */
extern const cli_option cli_tree_build_options[];
/** The parts of a command whose arguments are the struct T, with the cli_tree_args `tree`: first, and last but one. */
#define CLI_TREE_PART(T)                                                                                               \
    { "Scene", cli_tree_options, offsetof(T, tree) }
#define CLI_TREE_BUILD_PARTS(T)                                                                                        \
    {"Reading the scene", cli_scene_options + 1, offsetof(T, tree.scene)}, {                                           \
        "Building its tree", cli_tree_build_options, offsetof(T, tree)                                                 \
    }

/** Opens the folder of shards that SCENE is, see froe_is_shards(). Returns 0, or an exit code after saying why. */
int cli_open_shards(const cli_tree_args *args, froe_shards **shards);
/** Builds the tree of a scene that was read from `path`, with a progress bar, and the seed, the threads and the budget
 * of the command line. What else is wanted stands in `o`. Returns 0, or an exit code after saying why. */
int cli_build_tree(const cli_common *common, const char *path, uint64_t max_fragments, froe_scene *scene,
                   froe_build_options *o, froe_tree **tree);
/** Saves it. Returns 0, or an exit code after saying why. */
int cli_save_tree(const froe_tree *tree, const char *path);
/** Is the file a tree by its content, or by its name, when it was damaged? */
bool cli_is_saved_tree(const char *path);
/** Opens one, and refuses the options that only a scene that is read and built can obey. Returns 0, or an exit code
 * after saying why. */
int cli_open_saved_tree(const cli_common *common, const cli_tree_args *args, froe_tree **tree);
/** Opens a saved tree, or reads a scene and builds a tree for `purpose` (one of froe_build_options), with progress
 * bars, and saves it where --save-tree says. Returns 0, or an exit code after saying why. */
int cli_open_tree(const cli_common *common, const cli_tree_args *args, const char *purpose, froe_tree **tree);
/** The same for commands that read all of the tree: a file that is wrong is refused by its own name, before anything is
 * written. */
int cli_open_whole_tree(const cli_common *common, const cli_tree_args *args, const char *purpose, froe_tree **tree);
#endif
