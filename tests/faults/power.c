/* power.c: see power.h. Calls go straight to the system, so that none is led here again. */
#define _GNU_SOURCE 1 /* renameat2 */
#include "power.h"
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { MOST = 64 };

static struct {
    int file; /* of its own, so that it shares no lock; -1: the place is free */
    ino_t number;
} power_dirty[MOST];
static int power_dirty_count;

static struct {
    char from[PATH_MAX], to[PATH_MAX], kept[PATH_MAX]; /* kept: another name of what was there; "": nothing was */
    ino_t folder;
    bool exchanged;
} power_names[MOST];
static int power_name_count;
static char power_kept[PATH_MAX];

static ino_t number_of(int file) {
    struct stat about;
    return syscall(SYS_newfstatat, file, "", &about, AT_EMPTY_PATH) ? 0 : about.st_ino;
}

static int rename_now(const char *from, const char *to, unsigned how) {
    return (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, how);
}

void power_wrote(int file) {
    char path[40];
    const ino_t number = number_of(file);
    for (int i = 0; i < power_dirty_count; i++)
        if (power_dirty[i].number == number) return;
    if (power_dirty_count == MOST) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    const int again = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CLOEXEC);
    if (again < 0) return; /* a pipe */
    power_dirty[power_dirty_count].file = again;
    power_dirty[power_dirty_count++].number = number;
}

void power_synced(int file) {
    const ino_t number = number_of(file);
    int left = 0;
    for (int i = 0; i < power_dirty_count; i++)
        if (power_dirty[i].number == number)
            syscall(SYS_close, power_dirty[i].file);
        else
            power_dirty[left++] = power_dirty[i];
    power_dirty_count = left;
    left = 0;
    for (int i = 0; i < power_name_count; i++)
        if (power_names[i].folder == number)
            syscall(SYS_unlink, power_names[i].kept);
        else
            power_names[left++] = power_names[i];
    power_name_count = left;
}

void power_renames(const char *to) {
    snprintf(power_kept, sizeof power_kept, "%.4000s.%d.kept", to, power_name_count);
    if (link(to, power_kept)) power_kept[0] = '\0'; /* nothing is there, or a folder */
}

static void note(const char *from, const char *to, bool exchanged) {
    char folder[PATH_MAX];
    struct stat about;
    if (power_name_count == MOST) abort();
    snprintf(folder, sizeof folder, "%s", to);
    char *slash = strrchr(folder, '/');
    if (slash) slash[slash == folder] = '\0';
    if (syscall(SYS_newfstatat, AT_FDCWD, slash ? folder : ".", &about, 0)) abort();
    snprintf(power_names[power_name_count].from, PATH_MAX, "%s", from);
    snprintf(power_names[power_name_count].to, PATH_MAX, "%s", to);
    snprintf(power_names[power_name_count].kept, PATH_MAX, "%s", exchanged ? "" : power_kept);
    power_names[power_name_count].folder = about.st_ino;
    power_names[power_name_count++].exchanged = exchanged;
}

void power_renamed(const char *from, const char *to) {
    note(from, to, false);
}

void power_exchanged(const char *from, const char *to) {
    note(from, to, true);
}

void power_lose(bool back) {
    for (int i = power_name_count - 1; i >= 0; i--) {
        const char *from = power_names[i].from, *to = power_names[i].to, *kept = power_names[i].kept;
        if (back && rename_now(to, from, power_names[i].exchanged ? RENAME_EXCHANGE : 0)) abort();
        if (*kept && (back ? rename_now(kept, to, 0) : (int)syscall(SYS_unlink, kept))) abort();
    }
    for (int i = 0; i < power_dirty_count; i++)
        if (syscall(SYS_ftruncate, power_dirty[i].file, (off_t)0)) abort();
}
