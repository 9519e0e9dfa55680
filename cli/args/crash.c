/* crash.c: see crash.h. The handler reaches nothing but a static variable, and calls only functions that POSIX allows
 * in one. */
#define _XOPEN_SOURCE 700 /* sigaltstack */
#include "args/crash.h"
#include "exit.h"
#include "support/fail.h"
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const int signals[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
enum { SIGNALS = sizeof signals / sizeof *signals, NAME = 4200, SENTENCE = 200 };

/* What the handler needs. */
static struct {
    char line[NAME + SENTENCE]; /* the names of the program and of the file; then the sentence */
    cli_spool spool;
    volatile sig_atomic_t reading;
    struct sigaction before[SIGNALS];
    char stack[1 << 16]; /* for the handler: the program's own may be full */
} crash_guard;

_Noreturn static void end(int code, const char *said) {
    char *line = crash_guard.line;
    strncat(line, said, SENTENCE - 1);
    const size_t length = strlen(line);
    if (write(STDERR_FILENO, line, length) != (ssize_t)length) code = CLI_RESOURCES;
    if (*crash_guard.spool.folder) {
        unlink(crash_guard.spool.copy);
        rmdir(crash_guard.spool.folder);
    }
    _exit(code);
}

static void on_crash(int number) {
    (void)number;
    end(CLI_INPUT,
        ": The library that reads this format crashed. The file is broken, beyond the library, or needs more "
        "memory than there is.\n");
}

static void on_lost_page(int number) {
    (void)number;
    end(CLI_INPUT, ": The file was shortened while it was being read.\n");
}

void cli_crash_late(void) {
    if (crash_guard.reading) end(CLI_RESOURCES, ": It takes longer than --limit-time allows.\n");
}

static void begin_line(const char *name) {
    snprintf(crash_guard.line, NAME, "froe: %s", name);
    support_one_line(crash_guard.line);
}

void cli_crash_mapped(const char *name) {
    struct sigaction action;
    begin_line(name);
    memset(&action, 0, sizeof action);
    action.sa_handler = on_lost_page;
    sigaction(SIGBUS, &action, NULL);
}

void cli_crash_begin(const cli_spool *spool) {
    const stack_t own = {.ss_sp = crash_guard.stack, .ss_size = sizeof crash_guard.stack};
    struct sigaction action;
    begin_line(spool->name);
    crash_guard.spool = *spool;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_crash;
    action.sa_flags = (int)SA_RESETHAND | SA_ONSTACK;
    (void)sigaltstack(&own, NULL); /* without it the handler runs on the stack of the program */
    for (int i = 0; i < SIGNALS; i++) sigaction(signals[i], &action, &crash_guard.before[i]);
    crash_guard.reading = 1;
}

void cli_crash_end(void) {
    crash_guard.reading = 0;
    crash_guard.spool.folder[0] = '\0'; /* the spool's owner removes it */
    for (int i = 0; i < SIGNALS; i++) sigaction(signals[i], &crash_guard.before[i], NULL);
}
