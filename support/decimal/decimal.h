/* decimal.h: decimal numbers in text, correctly rounded, several times as fast as strtod() and printf(). */
#ifndef FROE_SUPPORT_DECIMAL_H
#define FROE_SUPPORT_DECIMAL_H
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/** As strtod() in the C locale, in what it takes and where it stops, for any text that ends with a NUL: the number at
 * the beginning, rounded to the nearest double, ties to even. *end is `text` where there is none. The calling thread
 * uses the C locale (support/locale.h). */
double support_decimal(const char *text, char **end);

/** So many bytes behind the NUL of a text may be read by the functions below, which take several digits at once. */
enum { SUPPORT_DECIMAL_AHEAD = 8 };
/** The same for a text with these bytes behind its NUL. */
double support_decimal_ahead(const char *text, char **end);

/** Room for what support_decimal_format() writes, read ahead as well. */
enum { SUPPORT_DECIMAL_ROOM = 40 };
/** As snprintf() with "%.*g" in the C locale: `digits` significant digits, without zeros at the end. Returns how many
 * characters that is; a NUL follows. 15 to 17 digits are quick. */
size_t support_decimal_format(char out[SUPPORT_DECIMAL_ROOM], double value, int digits);

/** Writes a whole number, at most 20 digits, and returns how many these are; no NUL follows. */
size_t support_decimal_whole(char *out, uint64_t value);

/** The double nearest to w 10^q, ties to even; infinite beyond the largest. */
double support_decimal_nearest(uint64_t w, long long q);

/** Passes the digits that stand at `at`, and appends them to w, which has no room for more than 19. Eight at once:
 * neighbours become numbers of two digits, then of four, then of eight (Lemire, "Quickly parsing eight digits", 2018).
 */
static inline const char *support_decimal_digits(const char *at, uint64_t *w) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    for (uint64_t eight;; at += 8) {
        memcpy(&eight, at, 8);
        const uint64_t high = UINT64_C(0xf0f0f0f0f0f0f0f0), zeros = UINT64_C(0x3030303030303030);
        if (((eight & high) | ((eight + UINT64_C(0x0606060606060606)) & high) >> 4) != UINT64_C(0x3333333333333333))
            break;
        eight -= zeros;
        eight = eight * 10 + (eight >> 8);
        eight = ((eight & UINT64_C(0x000000ff000000ff)) * UINT64_C(0x000f424000000064) +
                 (eight >> 16 & UINT64_C(0x000000ff000000ff)) * UINT64_C(0x0000271000000001)) >>
                32;
        *w = *w * 100000000 + (uint32_t)eight;
    }
#endif
    for (; (unsigned char)(*at - '0') < 10; at++) *w = 10 * *w + (uint64_t)(*at - '0');
    return at;
}
#endif
