/* contest.c: how well "auto" chooses. */
#include "compare/contest.h"
#include "compare/field.h"
#include <math.h>
#include <string.h>

static const char *const purposes[] = {"pieces", "query", "draw"};
enum { PURPOSES = sizeof purposes / sizeof *purposes };
static const char *const kinds[] = {"point", "window", "ray", "approximate"};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* Leaves of one object, or none, unless nothing can separate them: what makes pieces comparable. */
static double pieces(const json_t *row) {
    return field_number(row, "leaf") <= 1 && field_number(row, "crowded") == 0 ? field_number(row, "fragments") : NAN;
}

static double least_time(const json_t *rows, const char *kind) {
    double least = INFINITY;
    size_t i;
    json_t *row;
    json_array_foreach((json_t *)rows, i, row) {
        const double e = field_number(json_object_get(json_object_get(row, "queries"), kind), "microseconds");
        if (e < least) least = e; /* not for NaN */
    }
    return least;
}

/* Mean over the kinds, each relative to the quickest method at it. */
static double query_cost(const json_t *rows, const json_t *row) {
    double sum = 0;
    int count = 0;
    for (int k = 0; k < KINDS; k++) {
        const double least = least_time(rows, kinds[k]);
        if (!isfinite(least) || !(least > 0)) continue;
        sum += field_number(json_object_get(json_object_get(row, "queries"), kinds[k]), "microseconds") / least;
        count++;
    }
    return count ? sum / count : NAN;
}

static json_t *contest(const char *chosen, const char *purpose, const json_t *rows) {
    double best = INFINITY, own = NAN;
    const char *winner = NULL;
    size_t i;
    json_t *row;
    json_array_foreach((json_t *)rows, i, row) {
        const double cost = strcmp(purpose, "query") == 0 ? query_cost(rows, row) : pieces(row);
        const char *name = json_string_value(json_object_get(row, "method"));
        if (cost < best) best = cost, winner = name;
        if (strcmp(name, chosen) == 0) own = cost;
    }
    return json_pack("{s:s, s:s?, s:o}", "auto", chosen, "best", winner, "ratio",
                     own >= best ? json_real(own / best) : json_null());
}

json_t *contest_json(const froe_scene *scene, const json_t *rows) {
    json_t *out = json_object();
    for (int p = 0; p < PURPOSES; p++)
        json_object_set_new(out, purposes[p], contest(froe_method_auto(scene, purposes[p]), purposes[p], rows));
    return out;
}

/* Did the method that auto takes fail, and another succeed? */
static bool has_failed(const json_t *scene, const json_t *choice) {
    const json_t *row =
        field_row(json_object_get(scene, "methods"), json_string_value(json_object_get(choice, "auto")));
    return row && json_is_string(json_object_get(choice, "best")) && !field_is_built(row);
}

static json_t *sum_json(const json_t *scenes, const char *purpose) {
    int count = 0, best = 0, near = 0, failed = 0;
    double worst = 1;
    size_t i;
    json_t *scene;
    json_array_foreach((json_t *)scenes, i, scene) {
        const json_t *choice = json_object_get(json_object_get(scene, "auto"), purpose);
        const double ratio = field_number(choice, "ratio");
        const bool fails = has_failed(scene, choice);
        count += fails || !isnan(ratio);
        failed += fails;
        best += ratio <= 1; /* not for NaN */
        near += ratio <= 1.1;
        worst = fmax(worst, ratio);
    }
    return json_pack("{s:i, s:i, s:i, s:i, s:o}", "scenes", count, "best", best, "within_10_percent", near, "failed",
                     failed, "worst_ratio", count > failed ? json_real(worst) : json_null());
}

json_t *contest_sum_json(const json_t *scenes) {
    json_t *out = json_object();
    for (int p = 0; p < PURPOSES; p++) json_object_set_new(out, purposes[p], sum_json(scenes, purposes[p]));
    return out;
}
