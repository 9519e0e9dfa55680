/* redirect.h: what the program prints goes to a file for a while. */
#ifndef FROE_CLI_DEMO_REDIRECT_H
#define FROE_CLI_DEMO_REDIRECT_H

/** Lets what is printed go to a file from now on; *kept is where it went before. Returns 0 or an exit code after saying
 * why; demo_restore() follows in any case. */
int demo_redirect(const char *path, int *kept);

/** Lets it go where it went before. Returns 0, or an exit code after saying that the file could not be written. */
int demo_restore(const char *path, int kept);
#endif
