/* nice.c: see nice.h. Powers of ten come from strtod(), which rounds right; pow() differs between systems. */
#include "support/nice.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The round numbers around x, in ascending order. */
enum { AROUND = 9 };
static void around(double x, double *out) {
    char text[32];
    snprintf(text, sizeof text, "%.0e", x); /* no digits behind the point, and so no point of a locale */
    const char *exponent = strchr(text, 'e');
    const int power = exponent ? atoi(exponent + 1) : 0;
    for (int i = 0; i < AROUND; i++) {
        snprintf(text, sizeof text, "%de%d", i % 3 == 0 ? 1 : i % 3 == 1 ? 2 : 5, power - 1 + i / 3);
        out[i] = strtod(text, NULL);
    }
}

double support_nice_above(double x) {
    double round[AROUND];
    around(x, round);
    for (int i = 0; i < AROUND; i++)
        if (round[i] >= x) return round[i];
    return 0;
}

double support_nice_below(double x) {
    double round[AROUND];
    around(x, round);
    for (int i = AROUND; i-- > 0;)
        if (round[i] <= x) return round[i];
    return 0;
}
