/* decimal.h: decimal numbers in text, correctly rounded, several times as fast as strtod(). */
#ifndef FROE_SUPPORT_DECIMAL_H
#define FROE_SUPPORT_DECIMAL_H
#include <stdint.h>

/** As strtod() in the C locale, in what it takes and where it stops, for any text that ends with a NUL: the number at
 * the beginning, rounded to the nearest double, ties to even. *end is `text` where there is none. The calling thread
 * uses the C locale (support/locale.h). */
double support_decimal(const char *text, char **end);
/** The double nearest to w 10^q, ties to even; infinite beyond the largest. */
double support_decimal_nearest(uint64_t w, long long q);
#endif
