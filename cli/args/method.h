/* method.h: names of builders on command lines. */
#ifndef FROE_CLI_METHOD_H
#define FROE_CLI_METHOD_H
#include <froe/froe.h>

/** 0 if there is such a method, or if it is "auto" and that will do; otherwise says what there is and returns the exit
 * code. */
int cli_check_method(const char *name, bool may_be_auto);
#endif
