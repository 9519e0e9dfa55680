/* power.h: a loss of power, as far as files can show it. What was written and not synced since is lost: such a file is
 * empty. A name that was given by rename() may be there before its folder is synced, or not yet: both are tried. What
 * was removed is gone in both, as systems may write changes of several folders in any order.
 *
 * Those who lead calls to tests report them here; power_lose() leaves on the disk what would be there. */
#ifndef FROE_TESTS_POWER_H
#define FROE_TESTS_POWER_H
#include <stdbool.h>

/** A file was opened for writing, or written. */
void power_wrote(int file);
/** fsync() has brought a file or a folder to the disk. */
void power_synced(int file);
/** rename() is about to give a name; it has; or two names were exchanged. */
void power_renames(const char *to);
void power_renamed(const char *from, const char *to);
void power_exchanged(const char *from, const char *to);
/** What was not synced is lost; `back`: so are the names. */
void power_lose(bool back);
#endif
