/* main.c: finds the command, reads its arguments, runs it. */
#include "command.h"
#include "completion.h"
#include "exit.h"
#include "help.h"
#include "progress.h"
#include "report/report.h"
#include "version.h"
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

/* `froe --help [COMMAND]`, `froe help [COMMAND]`, and `froe --manual [COMMAND]`, which man pages are made with. */
static int run_help(int argc, char **argv, bool manual) {
    const cli_command *command = NULL;
    if (argc > 0) {
        command = cli_command_named(argv[0]);
        if (!command) return cli_refuse_command(argv[0]);
    }
    if (manual)
        cli_manual(stdout, command);
    else if (command)
        cli_help_command(stdout, command);
    else
        cli_help(stdout);
    return cli_flush();
}

static bool is(const char *word, const char *one, const char *other) {
    return strcmp(word, one) == 0 || strcmp(word, other) == 0;
}

/* Standard streams that the caller has closed stay without use: otherwise a file would be opened in their place, and
 * get what is said. Only complaints may vanish. (stdopen of gnulib) */
static void take_closed_streams(void) {
    for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++)
        if (fcntl(i, F_GETFD) < 0) (void)open("/dev/null", i == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
}

int main(int argc, char **argv) {
    take_closed_streams();
    if (argc < 2) {
        cli_help(stderr);
        return CLI_USE;
    }
    const char *word = argv[1];
    if (is(word, "--help", "-h") || strcmp(word, "help") == 0) return run_help(argc - 2, argv + 2, false);
    if (strcmp(word, "--manual") == 0) return run_help(argc - 2, argv + 2, true);
    if (strcmp(word, "--completion") == 0) return cli_completion(argc > 2 ? argv[2] : NULL);
    if (is(word, "--version", "-V")) return cli_version(argc > 2 && strcmp(argv[2], "--json") == 0);
    if (word[0] == '-') return cli_fail_unknown("option", word, NULL, "froe --help lists what there is.");
    const cli_command *command = cli_command_named(word);
    if (!command) return cli_refuse_command(word);
    cli_catch_signals();
    cli_report_begin();
    const int code = cli_run(command, argc - 2, argv + 2, NULL);
    if (code == CLI_CANCELLED) return cli_signal_code();
    if (code || !cli_interrupted() || cli_late()) return code;
    (void)cli_fail(code, NULL, "Cancelled when all was done, and what was written is whole.");
    return cli_signal_code();
}
