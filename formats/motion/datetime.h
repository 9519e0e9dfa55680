/* datetime.h: ISO 8601 instants as milliseconds since 1970, as Moving Features JSON counts them. */
#ifndef FROE_FORMATS_DATETIME_H
#define FROE_FORMATS_DATETIME_H
#include "support/arithmetic.h"
#include <stdbool.h>

/** "2020-02-29", "2020-02-29T12:00:00Z", "2020-02-29T12:00:00.25+01:00", ... (without a zone: UTC); the double nearest
 * to the exact value. False: it is no such instant. */
bool formats_datetime(const char *text, double *milliseconds);
#endif
