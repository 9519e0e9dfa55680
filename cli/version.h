/* version.h: froe --version. */
#ifndef FROE_CLI_VERSION_H
#define FROE_CLI_VERSION_H
#include <stdbool.h>

/** Prints version, commit and compiled-in features; returns an exit code. */
int cli_version(bool json);
/** The commit this was built from, or "unknown". */
const char *cli_commit(void);
#endif
