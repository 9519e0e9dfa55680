/* contest.c: how well "auto" chooses. */
#include "compare/contest.h"
#include <math.h>
#include <string.h>

static const char *const purposes[] = {"pieces", "query", "draw"};
enum { PURPOSES = sizeof purposes / sizeof *purposes };
static const char *const kinds[] = {"point", "window", "ray", "approximate"};
enum { KINDS = sizeof kinds / sizeof *kinds };

static double number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

/* Leaves of one object, or none, unless nothing can separate them: what makes pieces comparable. */
static double pieces(const json_t *row) {
    return number(row, "leaf") <= 1 && number(row, "crowded") == 0 ? number(row, "fragments") : NAN;
}

static double least_time(const json_t *rows, const char *kind) {
    double least = INFINITY;
    size_t i;
    json_t *row;
    json_array_foreach((json_t *)rows, i, row) {
        const double e = number(json_object_get(json_object_get(row, "queries"), kind), "microseconds");
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
        sum += number(json_object_get(json_object_get(row, "queries"), kinds[k]), "microseconds") / least;
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

/* Was the method that auto takes tried in vain, though another served? */
static bool has_failed(const json_t *scene, const json_t *choice) {
    size_t i;
    json_t *row;
    json_array_foreach(json_object_get(scene, "methods"), i,
                       row) if (strcmp(json_string_value(json_object_get(row, "method")),
                                       json_string_value(json_object_get(choice, "auto"))) ==
                                0) return json_is_string(json_object_get(choice, "best")) &&
        strcmp(json_string_value(json_object_get(row, "status")), "ok") != 0;
    return false;
}

static json_t *sum_json(const json_t *scenes, const char *purpose) {
    int count = 0, best = 0, near = 0, failed = 0;
    double worst = 1;
    size_t i;
    json_t *scene;
    json_array_foreach((json_t *)scenes, i, scene) {
        const json_t *choice = json_object_get(json_object_get(scene, "auto"), purpose);
        const double ratio = number(choice, "ratio");
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
