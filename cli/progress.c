/* progress.c: the progress bar and the flag that signals set. A signal handler
 * can reach nothing but a static variable, so the flag is one; it lives here only. */
#include "progress.h"
#include "args/crash.h"
#include "exit.h"
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t interrupted; /* the number of the first signal */

static void on_signal(int number) {
    if (!interrupted) interrupted = number;
}

/* The time is up, and then again each second: a library that reads a file may not listen. */
static void on_alarm(int number) {
    if (interrupted == SIGALRM) cli_crash_late();
    on_signal(number);
}

static void catch_signal(int number, void (*handler)(int), int flags) {
    struct sigaction action, before = {.sa_handler = SIG_DFL};
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigaction(number, NULL, &before);
    if (before.sa_handler != SIG_IGN) sigaction(number, &action, NULL);
}

void cli_catch_signals(void) {
    static const int ends[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) catch_signal(ends[i], on_signal, (int)SA_RESETHAND);
    catch_signal(SIGALRM, on_alarm, 0);
    catch_signal(SIGXFSZ, SIG_IGN, 0); /* a file beyond the allowed size: write() fails instead */
}

bool cli_interrupted(void) {
    return interrupted != 0;
}

bool cli_late(void) {
    return interrupted == SIGALRM;
}

int cli_signal_code(void) {
    return 128 + (int)interrupted;
}

cli_progress cli_progress_begin(const cli_common *common, const char *what) {
    return (cli_progress){.what = what, .visible = !common->quiet && isatty(STDERR_FILENO), .percent = -1};
}

bool cli_progress_step(void *progress, double done) {
    enum { WIDTH = 40 };
    cli_progress *bar = progress;
    const int percent = done <= 0 ? 0 : done >= 1 ? 100 : (int)(done * 100);
    if (bar->visible && percent != bar->percent) {
        static const char full[WIDTH + 1] = "########################################";
        bar->percent = percent;
        fprintf(stderr, "\r%-12s [%-*.*s] %3d %%", bar->what, WIDTH, percent * WIDTH / 100, full, percent);
        fflush(stderr);
    }
    return !interrupted;
}

void cli_progress_end(cli_progress *progress) {
    if (progress->visible && progress->percent >= 0) fputs("\r\033[K", stderr);
    progress->percent = -1;
}
