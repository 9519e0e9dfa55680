/* datetime.c: see datetime.h. */
#include "formats/motion/datetime.h"
#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Exactly `digits` digits, and no number beyond `most`. */
static bool take_number(const char **at, int digits, int most, int *out) {
    *out = 0;
    for (; digits; digits--, ++*at) {
        if (!isdigit((unsigned char)**at)) return false;
        *out = 10 * *out + (**at - '0');
    }
    return *out <= most;
}

static bool take_character(const char **at, char c) {
    return **at == c && *(*at)++;
}

/* Days since 1970. From the first of March of the year before or of this one on, the era of 400 years has 146 097 days,
 * and months have 153 days in fives. */
static bool take_date(const char **at, int64_t *days) {
    static const int lengths[] = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    int year, month, day;
    if (!take_number(at, 4, 9999, &year) || !take_character(at, '-') || !take_number(at, 2, 12, &month) ||
        !take_character(at, '-') || !take_number(at, 2, 31, &day))
        return false;
    const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    if (!year || !month || !day || day > lengths[month - 1] || (month == 2 && day == 29 && !leap)) return false;
    const int y = month < 3 ? year - 1 : year, m = month < 3 ? month + 9 : month - 3;
    const int64_t leaps = y / 4 - y / 100 + y / 400;
    *days = 365 * (int64_t)y + leaps + (153 * m + 2) / 5 + day - 1 - 719468;
    return true;
}

/* Minutes and seconds may be missing; *digits: what stands behind the point, 0 to 17 of them count. */
static bool take_clock(const char **at, int *seconds, char digits[18]) {
    int hour, minute = 0, second = 0;
    size_t count = 0;
    if (!take_number(at, 2, 24, &hour)) return false;
    if (take_character(at, ':') && !take_number(at, 2, 59, &minute)) return false;
    if (take_character(at, ':') && !take_number(at, 2, 60, &second)) return false;
    if (**at == '.' || **at == ',')
        for (++*at; isdigit((unsigned char)**at); ++*at)
            if (count < 17) digits[count++] = **at;
    digits[count] = '\0';
    *seconds = (hour * 60 + minute) * 60 + second;
    return hour < 24 || (*seconds == 24 * 3600 && !digits[strspn(digits, "0")]);
}

static bool take_zone(const char **at, int *minutes) {
    int hours = 0, rest = 0;
    *minutes = 0;
    if (!**at || take_character(at, 'Z') || take_character(at, 'z')) return true;
    int sign = take_character(at, '+') ? 1 : take_character(at, '-') ? -1 : 0;
    if (!sign || !take_number(at, 2, 23, &hours)) return false;
    if ((take_character(at, ':') || **at) && !take_number(at, 2, 59, &rest)) return false;
    *minutes = sign * (60 * hours + rest);
    return true;
}

bool formats_datetime(const char *text, double *milliseconds) {
    int64_t days;
    int seconds = 0, zone = 0;
    char digits[18] = "";
    if (!take_date(&text, &days)) return false;
    if (*text) {
        if (!take_character(&text, 'T') && !take_character(&text, 't') && !take_character(&text, ' ')) return false;
        if (!take_clock(&text, &seconds, digits) || !take_zone(&text, &zone) || *text) return false;
    }
    /* 1000 (since + 0.digits), read as one decimal number, so that it is rounded once */
    const int64_t since = days * 86400 + seconds - 60 * (int64_t)zone;
    char number[48], fraction[24];
    snprintf(fraction, sizeof fraction, "%s000", digits);
    if (since >= 0)
        snprintf(number, sizeof number, "%lld%.3s.%s", (long long)since, fraction, fraction + 3);
    else /* before 1970 */
        snprintf(number, sizeof number, "%.3s.%s", fraction, fraction + 3);
    *milliseconds = strtod(number, NULL) + (since < 0 ? 1000 * (double)since : 0);
    return true;
}
