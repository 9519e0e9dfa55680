/* tree_report.h: the report on a tree; shared by build, check and demo. */
#ifndef FROE_CLI_TREE_REPORT_H
#define FROE_CLI_TREE_REPORT_H
#include "report/report.h"
#include <froe/froe.h>

typedef struct cli_build_seconds {
    double read, build;
} cli_build_seconds;

/** All of froe_tree_report() as a JSON object; NULL without memory. */
json_t *cli_tree_json(const froe_tree *tree);
/** Prints the report of a build. `output` may be NULL. Returns 0 or an exit code. */
int cli_report_build(const cli_common *common, const char *scene, const char *output, const froe_tree *tree,
                     cli_build_seconds seconds);
#endif
