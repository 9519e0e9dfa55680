/* order.h: an order of objects from a text file. */
#ifndef FROE_CLI_ORDER_H
#define FROE_CLI_ORDER_H
#include <stddef.h>
#include <stdint.h>

/** Reads the ids of so many objects, each once, one a line (blank lines and lines that begin with # are passed over).
 * *out is to be freed, also on failure. Exit code, 0: read. */
int cli_read_order(const char *path, size_t objects, uint32_t **out);
#endif
