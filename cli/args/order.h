/* order.h: an order of objects from a text file. */
#ifndef FROE_CLI_ORDER_H
#define FROE_CLI_ORDER_H
#include <stddef.h>
#include <stdint.h>

typedef struct cli_order {
    uint32_t *ids; /**< to be freed */
    size_t count;
} cli_order;

/** Reads object ids, one a line (blank lines and lines that begin with # are passed over). Exit code, 0: read. */
int cli_read_order(const char *path, cli_order *out);
#endif
