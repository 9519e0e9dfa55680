/* budget.h: the most pieces that a command builds, so that no scene makes a machine swap. */
#ifndef FROE_CLI_BUDGET_H
#define FROE_CLI_BUDGET_H
#include "args/options.h"
#include "exit.h"

/** What --max-fragments is when it is not given. */
#define CLI_BUDGET_OWN UINT64_MAX
#define CLI_BUDGET_OPTION(T, member)                                                                                   \
    {                                                                                                                  \
        "max-fragments", 0, CLI_WHOLE, offsetof(T, member), "N",                                                       \
            .help = "give up beyond so many pieces (default: a million, and 64 for each object; 0: never)"             \
    }

/** The budget for a scene, for max_fragments of froe_build_options: what is given, or 10^6 + 64 for each object. */
uint64_t cli_budget(uint64_t given, const froe_scene *scene);
/** cli_fail_status() of a build; a budget that was too small is told with the option that sets it. */
int cli_fail_build(const char *file, uint64_t given, const froe_scene *scene, froe_status status,
                   const froe_diagnostic *diag);
#endif
