/* progress.c: the progress bar and the flag that Ctrl-C sets. A signal handler
 * can reach nothing but a static variable, so the flag is one; it lives here only. */
#include "progress.h"
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t interrupted;

static void on_interrupt(int number) {
    (void)number;
    interrupted = 1;
}

void cli_catch_signals(void) {
    struct sigaction action, before;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_interrupt;
    action.sa_flags = (int)SA_RESETHAND;
    if (sigaction(SIGINT, NULL, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(SIGINT, &action, NULL);
    action.sa_handler = SIG_IGN; /* a file beyond the allowed size: write() fails instead */
    sigaction(SIGXFSZ, &action, NULL);
}

bool cli_interrupted(void) {
    return interrupted != 0;
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
