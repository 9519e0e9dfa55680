/* page.h: the comparison as one page that needs nothing beside it. */
#ifndef FROE_CLI_COMPARE_PAGE_H
#define FROE_CLI_COMPARE_PAGE_H
#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

/** A cli_write_fn: the page; `user` is the comparison. */
bool page_put(FILE *out, const void *user);
#endif
