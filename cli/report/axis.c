/* axis.c: scales of figures. Ticks stand at 1, 2 and 5 times powers of ten, on logarithmic axes of many decades at the
 * powers alone. */
#include "report/axis.h"
#include "support/nice.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

plot_axis plot_axis_new(bool log) {
    return (plot_axis){.log = log, .lo = INFINITY, .hi = -INFINITY};
}

bool plot_axis_shows(const plot_axis *axis, double value) {
    return isfinite(value) && fabs(value) < 1e15 && (!axis->log || value > 1e-15);
}

void plot_axis_add(plot_axis *axis, double value) {
    if (!plot_axis_shows(axis, value)) return;
    if (value < axis->lo) axis->lo = value;
    if (value > axis->hi) axis->hi = value;
}

/* The tick distance that gives some six of them. */
static double step_of(const plot_axis *axis) {
    return support_nice_above((axis->hi - axis->lo) / 6);
}

void plot_axis_round(plot_axis *axis) {
    if (axis->lo > axis->hi) axis->lo = axis->log ? 1 : 0, axis->hi = axis->log ? 10 : 1;
    if (axis->log) {
        if (axis->hi < axis->lo * 3) axis->lo /= 2, axis->hi *= 2;
        axis->lo /= 1.1, axis->hi *= 1.1;
        return;
    }
    if (axis->lo > 0) axis->lo = 0;
    if (axis->hi <= axis->lo) axis->hi = axis->lo + 1;
    const double step = step_of(axis);
    axis->lo = step * floor(axis->lo / step);
    axis->hi = step * ceil(axis->hi / step);
}

double plot_axis_at(const plot_axis *axis, double value) {
    double share = (value - axis->lo) / (axis->hi - axis->lo);
    if (axis->log) share = log10(value / axis->lo) / log10(axis->hi / axis->lo);
    return axis->from + share * (axis->to - axis->from);
}

size_t plot_axis_ticks(const plot_axis *axis, double *out) {
    size_t count = 0;
    if (!axis->log) {
        const double step = step_of(axis), first = ceil(axis->lo / step - 1e-9);
        const double end = axis->hi + 1e-9 * step;
        for (double i = first; count < PLOT_TICKS && i * step <= end; i++) /* one way: the step gives some six */
            out[count++] = i * step;
        return count;
    }
    const double decades = log10(axis->hi / axis->lo);
    const int each = decades < 2.5 ? 3 : 1, stride = decades < 9 ? 1 : 3;
    for (int e = (int)floor(log10(axis->lo)); e <= (int)ceil(log10(axis->hi)); e++)
        for (int i = 0; i < each && e % stride == 0; i++) {
            const double value = (i == 0 ? 1 : i == 1 ? 2 : 5) * pow(10, e);
            if (value < axis->lo || value > axis->hi) continue;
            if (count < PLOT_TICKS) out[count++] = value; /* one way: each decade or third one has a tick */
        }
    return count;
}

/* Whole numbers of thousandths, so that no decimal point comes from the locale. */
static void put_thousandths(long long value, const char *suffix, char *text) {
    const long long size = value < 0 ? -value : value;
    int used = snprintf(text, 16, "%s%lld", value < 0 ? "-" : "", size / 1000);
    if (size % 1000) {
        used += snprintf(text + used, 6, ".%03lld", size % 1000);
        while (text[used - 1] == '0') text[--used] = '\0';
    }
    snprintf(text + used, 3, "%s", suffix);
}

void plot_axis_label(double value, char *text) {
    static const struct {
        double unit;
        const char *suffix;
    } units[] = {{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}};
    const double size = fabs(value) * (1 + 1e-12);
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (size >= units[i].unit) {
            put_thousandths(llround(value / units[i].unit * 1000), units[i].suffix, text);
            return;
        }
    const int power = value == 0 ? 0 : (int)floor(log10(size));
    if (power >= -3)
        put_thousandths(llround(value * 1000), "", text);
    else
        snprintf(text, 24, "%.0fe%d", value / pow(10, power), power);
}
