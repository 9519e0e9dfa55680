/* budget.c: see budget.h. */
#include "args/budget.h"
#include <inttypes.h>

uint64_t cli_budget(uint64_t given, const froe_scene *scene) {
    enum { PIECES = 1000000, EACH = 64 };
    return given != CLI_BUDGET_OWN ? given : PIECES + EACH * (uint64_t)froe_scene_object_count(scene);
}

int cli_fail_build(const char *file, uint64_t given, const froe_scene *scene, froe_status status,
                   const froe_diagnostic *diag) {
    if (status != FROE_E_BUDGET) return cli_fail_status(CLI_WORKING, file, status, diag);
    return cli_fail(CLI_RESOURCES, file,
                    "More than %" PRIu64 " pieces are needed. --max-fragments N allows more, and 0 any number.",
                    cli_budget(given, scene));
}
