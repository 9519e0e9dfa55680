/* redirect.c: see redirect.h. */
#include "demo/redirect.h"
#include "exit.h"
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <unistd.h>

int demo_redirect(const char *path, int *kept) {
    fflush(stdout);
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    *kept = dup(STDOUT_FILENO);
    const bool open_both = file >= 0 && *kept >= 0;
    if (open_both) (void)dup2(file, STDOUT_FILENO); /* nothing refuses what is open */
    if (file >= 0) close(file);
    return open_both ? 0 : cli_fail_file(CLI_RESOURCES, path, "written");
}

int demo_restore(const char *path, int kept) {
    const bool written = fflush(stdout) == 0;
    const bool back = kept >= 0 && dup2(kept, STDOUT_FILENO) >= 0;
    if (kept >= 0) close(kept);
    return written && back ? 0 : cli_fail_file(CLI_RESOURCES, path, "written");
}
