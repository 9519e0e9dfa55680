/* crash.c: see crash.h. The handler reaches nothing but static variables, and calls only functions that POSIX allows in
 * a handler. */
#define _XOPEN_SOURCE 700 /* sigaltstack */
#include "args/crash.h"
#include "exit.h"
#include "support/fail.h"
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const int signals[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
enum { SIGNALS = sizeof signals / sizeof *signals };

static char name[4096]; /* of the file */
static cli_spool spooled;
static struct sigaction before[SIGNALS];
static char stack[1 << 16]; /* for the handler: the program's own may be full */

static void on_crash(int number) {
    static const char said[] =
        ": The library that reads this format crashed. The file is broken, or beyond the library.\n";
    (void)number;
    const bool told = write(STDERR_FILENO, "froe: ", strlen("froe: ")) > 0 &&
                      write(STDERR_FILENO, name, strlen(name)) > 0 && write(STDERR_FILENO, said, strlen(said)) > 0;
    if (*spooled.folder) {
        unlink(spooled.copy);
        rmdir(spooled.folder);
    }
    _exit(told ? CLI_INPUT : CLI_RESOURCES);
}

void cli_crash_begin(const cli_spool *spool) {
    const stack_t own = {.ss_sp = stack, .ss_size = sizeof stack};
    struct sigaction action;
    snprintf(name, sizeof name, "%s", spool->name);
    support_one_line(name);
    spooled = *spool;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_crash;
    action.sa_flags = (int)SA_RESETHAND | (sigaltstack(&own, NULL) ? 0 : SA_ONSTACK);
    for (int i = 0; i < SIGNALS; i++) sigaction(signals[i], &action, &before[i]);
}

void cli_crash_end(void) {
    for (int i = 0; i < SIGNALS; i++) sigaction(signals[i], &before[i], NULL);
}
