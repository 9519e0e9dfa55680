/* contest.c: how well "auto" chooses. */
#include "compare/contest.h"
#include "compare/field.h"
#include <math.h>
#include <string.h>

static const char *const purposes[] = {"pieces", "query", "draw"};
enum { PURPOSES = sizeof purposes / sizeof *purposes };
static const char *const kinds[] = {"point", "window", "ray", "approximate"};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* Of a kind of query, in the mean; NaN: it was not measured. */
static double microseconds(const json_t *row, const char *kind) {
    return field_number(json_object_get(json_object_get(row, "queries"), kind), "microseconds");
}

/* What the tree of a row costs for a purpose; NaN: it cannot be compared. */
static double cost_of(const json_t *rows, const json_t *row, const char *purpose) {
    /* Leaves of one object, or none, unless nothing can separate them: what makes pieces comparable. */
    if (strcmp(purpose, "query") != 0)
        return field_number(row, "leaf") <= 1 && field_number(row, "crowded") == 0 ? field_number(row, "fragments")
                                                                                   : NAN;
    /* Mean over the kinds, each relative to the quickest method at it. */
    double sum = 0;
    int count = 0;
    for (int k = 0; k < KINDS; k++) {
        double least = INFINITY;
        size_t i;
        json_t *other;
        json_array_foreach((json_t *)rows, i, other) {
            const double e = microseconds(other, kinds[k]);
            if (e < least) least = e; /* not for NaN */
        }
        if (!isfinite(least) || !(least > 0)) continue;
        sum += microseconds(row, kinds[k]) / least;
        count++;
    }
    return count ? sum / count : NAN;
}

json_t *contest_json(const froe_scene *scene, const json_t *rows) {
    json_t *out = json_object();
    for (int p = 0; p < PURPOSES; p++) {
        const char *chosen = froe_method_auto(scene, purposes[p]), *winner = NULL;
        double best = INFINITY, own = NAN;
        size_t i;
        json_t *row;
        json_array_foreach((json_t *)rows, i, row) {
            const double cost = cost_of(rows, row, purposes[p]);
            const char *name = json_string_value(json_object_get(row, "method"));
            if (cost < best) best = cost, winner = name;
            if (strcmp(name, chosen) == 0) own = cost;
        }
        json_object_set_new(out, purposes[p],
                            json_pack("{s:s, s:s?, s:o}", "auto", chosen, "best", winner, "ratio",
                                      own >= best ? json_real(own / best) : json_null()));
    }
    return out;
}

json_t *contest_sum_json(const json_t *scenes) {
    json_t *out = json_object();
    for (int p = 0; p < PURPOSES; p++) {
        int count = 0, best = 0, near = 0, failed = 0;
        double worst = 1;
        size_t i;
        json_t *scene;
        json_array_foreach((json_t *)scenes, i, scene) {
            const json_t *choice = json_object_get(json_object_get(scene, "auto"), purposes[p]);
            const char *chosen = json_string_value(json_object_get(choice, "auto"));
            const json_t *row = field_row(json_object_get(scene, "methods"), chosen);
            const double ratio = field_number(choice, "ratio");
            /* The method that auto takes failed, and another succeeded. */
            const bool fails = row && json_is_string(json_object_get(choice, "best")) && !field_is_built(row);
            count += fails || !isnan(ratio);
            failed += fails;
            best += ratio <= 1; /* not for NaN */
            near += ratio <= 1.1;
            worst = fmax(worst, ratio);
        }
        json_object_set_new(out, purposes[p],
                            json_pack("{s:i, s:i, s:i, s:i, s:o}", "scenes", count, "best", best, "within_10_percent",
                                      near, "failed", failed, "worst_ratio",
                                      count > failed ? json_real(worst) : json_null()));
    }
    return out;
}
