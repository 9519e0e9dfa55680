/* crash.h: what a user is told when a library crashes on a file. */
#ifndef FROE_CLI_CRASH_H
#define FROE_CLI_CRASH_H
#include "args/spool.h"

/** Until cli_crash_end() a crash (a fault of memory, an abort, a stack that overflows) ends the program with a message
 * that names the file, and with exit code CLI_INPUT; a spooled copy is removed. GDAL and assimp read a hundred formats,
 * and some broken files crash them. */
void cli_crash_begin(const cli_spool *spool);
void cli_crash_end(void);
/** In a handler of a signal: between these calls, ends the program with exit code CLI_RESOURCES, after saying that the
 * file takes longer than allowed; otherwise does nothing. */
void cli_crash_late(void);
/** Of a file that is mapped from here on: when another program has shortened it, reading it ends the program with a
 * message and with exit code CLI_INPUT. */
void cli_crash_mapped(const char *name);
#endif
