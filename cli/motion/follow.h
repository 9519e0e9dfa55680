/* follow.h: a motion followed event by event, for froe simulate. */
#ifndef FROE_CLI_MOTION_FOLLOW_H
#define FROE_CLI_MOTION_FOLLOW_H
#include "args/output.h"
#include "command.h"
#include <froe/io.h>
#include <jansson.h>

/** Names of files that a command has written. */
typedef struct cli_written {
    const char *names[8];
    size_t count;
} cli_written;

typedef struct cli_follow {
    const char *events, *places; /**< files to write, or NULL */
    cli_output tree;
    double at;        /**< when the tree is taken; NaN: never */
    bool unrounded;   /**< rather no tree than one with rounded coordinates */
    bool augmented;   /**< segments turn upright for nothing */
    bool ghosts;      /**< triangles that meet others are left out meanwhile */
    int up;           /**< the axis that points up in pictures of the tree */
    double deviation; /**< of what replaces bodies, as a share of the size of what moves; NaN: the usual one */
} cli_follow;

/** Is the partition asked for? */
static inline bool cli_follows(const cli_follow *asked) {
    return asked->events || asked->tree.name;
}
/** Is what is asked for possible for a motion? Returns 0, or an exit code after saying why. */
int cli_check_follow(const cli_follow *asked, const char *file, const froe_motion *motion);
/** Goes through the window of a motion from a file, if anything is asked for; events are written as they happen.
 * *report: what there was, or null. Returns an exit code, after saying why. What is written is added to `written`. */
int cli_follow_motion(const cli_common *common, const cli_follow *asked, const char *file, froe_motion *motion,
                      json_t **report, cli_written *written);
#endif
