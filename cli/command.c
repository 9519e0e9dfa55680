/* command.c: the registry of commands, and how one is run. */
#include "command.h"
#include "allowance.h"
#include "args/output.h"
#include "args/overwrite.h"
#include "exit.h"
#include "help.h"
#include "report/report.h"
#include <stdlib.h>
#include <string.h>

#define FROE_COMMAND(name) extern const cli_command cli_command_##name;
#include "commands.def"
#undef FROE_COMMAND

static const cli_command *const commands[] = {
#define FROE_COMMAND(name) &cli_command_##name,
#include "commands.def"
#undef FROE_COMMAND
};
enum { COMMANDS = sizeof commands / sizeof *commands };

const cli_command *cli_command_at(size_t i) {
    return i < COMMANDS ? commands[i] : NULL;
}

const cli_command *cli_command_named(const char *name) {
    for (size_t i = 0; i < COMMANDS; i++)
        if (strcmp(commands[i]->name, name) == 0) return commands[i];
    return NULL;
}

int cli_refuse_command(const char *name) {
    const char *names[COMMANDS];
    for (size_t i = 0; i < COMMANDS; i++) names[i] = commands[i]->name;
    const char *hint = cli_nearest(name, names, COMMANDS);
    return cli_fail_unknown("command", name, hint, hint ? NULL : "froe --help lists what there is.");
}

int cli_run(const cli_command *command, int argc, char **argv, json_t **report) {
    void *args = malloc(command->size);
    if (!args) return cli_fail_memory();
    memcpy(args, command->defaults, command->size);
    int code = cli_parse(command->name, command->parts, argc, argv, args);
    if (!code && ((cli_common *)args)->help) {
        cli_help_command(stdout, command);
        code = cli_flush();
    } else if (!code) {
        ((cli_common *)args)->report = report;
        code = cli_limit(args);
        if (!code) code = cli_check_overwrite(command->parts, args);
        if (!code) code = cli_output_open(command->parts, args);
        if (!code) code = cli_output_close(command->parts, args, command->run(args));
    }
    cli_release(command->parts, args);
    free(args);
    return code;
}
