/* decimal.h: decimal numbers in text, correctly rounded, several times as fast as strtod(). */
#ifndef FROE_SUPPORT_DECIMAL_H
#define FROE_SUPPORT_DECIMAL_H

/** As strtod() in the C locale, in what it takes and where it stops, for any text that ends with a NUL: the number at
 * the beginning, rounded to the nearest double, ties to even. *end is `text` where there is none. The calling thread
 * uses the C locale (support/locale.h). */
double support_decimal(const char *text, char **end);
#endif
