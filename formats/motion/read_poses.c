/* read_poses.c: froe_read_poses: the parts of a model at instants, from a table.
 *
 *     body,time,x,y,z,qx,qy,qz,qw      a row: where the part of that name is at an instant, and how it is turned
 *     door,0,0,0,0,0,0,0,1
 *
 * and of a plan, which is in the plane, with the columns body,time,x,y,qz,qw.
 *
 * Each part (group) with rows is a body; all the others are one body that stands still, as they do not move against one
 * another. */
#include "formats/input/bodies.h"
#include "formats/motion/solids.h"
#include "support/array.h"
#include "support/decimal/decimal.h"
#include "support/floats.h"
#include "support/locale.h"
#include "support/path.h"
#include "support/text/csv.h"
#include <errno.h>
#include <froe/formats.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BODY, TIME, PLACE, TURN = PLACE + 3, COLUMNS = TURN + 4 };
static const char *const column_names[COLUMNS] = {"body", "time", "x", "y", "z", "qx", "qy", "qz", "qw"};

typedef struct pose {
    uint32_t group;
    double at[COLUMNS]; /* at[BODY] is not used */
} pose;

typedef struct part_name {
    const char *name;
    uint32_t group;
} part_name;

typedef struct pose_reading {
    const char *path;
    const froe_scene *model;
    froe_allocator alloc;
    froe_diagnostic *diag;
    froe_motion *motion;
    froe_motion_report report;
    double first, last; /* instants of all */
    bool turning;       /* the table has turns */
    int column[SUPPORT_CSV_COLUMNS], columns;
    uint64_t line;
    ARRAY(pose) poses;
    ARRAY(part_name) names;    /* ascending */
    ARRAY(size_t) starts;      /* [group]: the first of its rows in order; one more */
    ARRAY(uint32_t) order;     /* rows by groups, each in the order of the file */
    ARRAY(uint32_t) body;      /* [group] */
    ARRAY(double) numbers;     /* of one body */
    ARRAY(formats_life) lives; /* of each part */
    ARRAY(size_t) each;
    ARRAY(uint32_t) parts; /* of each object */
} pose_reading;

static froe_status no_room(const pose_reading *r) {
    return support_fail_memory(r->diag);
}

/* ---------------------------------------------------------------------- table -- */

static int by_name(const void *a, const void *b) {
    return strcmp(((const part_name *)a)->name, ((const part_name *)b)->name);
}

static froe_status name_parts(pose_reading *r) {
    for (uint32_t i = 0; i < froe_scene_group_count(r->model); i++)
        if (!array_push(&r->alloc, &r->names, (part_name){froe_scene_group(r->model, i).name, i})) return no_room(r);
    if (r->names.count) qsort(r->names.data, r->names.count, sizeof *r->names.data, by_name);
    return FROE_OK;
}

static int dim_of(const pose_reading *r) {
    return froe_scene_dim(r->model);
}

/* In the plane there is no z, and nothing turns about x or y; see stays_in_plane(). */
static bool is_read(const pose_reading *r, int column) {
    return dim_of(r) == 3 || (column != PLACE + 2 && column != TURN && column != TURN + 1);
}

static froe_status read_pose_header(pose_reading *r, char **at, char separator) {
    bool last = false;
    int found = 0;
    for (r->columns = 0; !last; r->columns++) {
        const support_csv_field field = support_csv_next(at, separator);
        last = field.last;
        if (r->columns == SUPPORT_CSV_COLUMNS)
            return support_fail(r->diag, FROE_E_LIMIT, "%s: There are more than %d columns.", support_short(r->path),
                                SUPPORT_CSV_COLUMNS);
        r->column[r->columns] = COLUMNS;
        for (int k = 0; k < COLUMNS; k++)
            if (strcmp(field.text, column_names[k]) == 0 && !(found >> k & 1)) {
                r->column[r->columns] = k;
                found |= 1 << k;
            }
    }
    for (int k = TURN; k < COLUMNS; k++) r->turning = r->turning || (is_read(r, k) && (found >> k & 1));
    for (int k = 0; k < (r->turning ? COLUMNS : TURN); k++)
        if (is_read(r, k) && !(found >> k & 1))
            return support_fail(r->diag, FROE_E_FORMAT, "%s: The table of poses has no column '%s'.",
                                support_short(r->path), column_names[k]);
    r->line = 2;
    return FROE_OK;
}

static froe_status read_pose(pose_reading *r, char **at, char separator) {
    pose p = {.at = {[COLUMNS - 1] = 1}};
    bool last = false;
    uint64_t more = 0;
    int column = 0;
    for (; !last; column++) {
        const support_csv_field field = support_csv_next(at, separator);
        last = field.last;
        more += support_csv_line_ends(&field);
        if (field.open)
            return support_fail(r->diag, FROE_E_FORMAT, "%s: line %llu: A quotation mark is not closed.",
                                support_short(r->path), (unsigned long long)r->line);
        const int role = column < r->columns ? r->column[column] : COLUMNS;
        if (role == BODY) {
            const part_name key = {field.text, 0};
            const part_name *part =
                !r->names.count ? NULL : bsearch(&key, r->names.data, r->names.count, sizeof *r->names.data, by_name);
            if (!part)
                return support_fail(r->diag, FROE_E_INPUT, "%s: line %llu: The model has no part '%.60s'.",
                                    support_short(r->path), (unsigned long long)r->line, field.text);
            p.group = part->group;
        } else if (role < COLUMNS &&
                   (!support_csv_number(field.text, separator, &p.at[role]) || !isfinite(p.at[role]))) {
            return support_fail(r->diag, FROE_E_INPUT, "%s: line %llu: There is no finite number, but '%.60s'.",
                                support_short(r->path), (unsigned long long)r->line, field.text);
        }
    }
    if (column != r->columns)
        return support_fail(r->diag, FROE_E_FORMAT, "%s: line %llu: The row has %d column%s, and the header %d.",
                            support_short(r->path), (unsigned long long)r->line, column,
                            support_plural((uint64_t)column), r->columns);
    r->line += 1 + more;
    if (p.at[TIME] < r->first) r->first = p.at[TIME];
    if (p.at[TIME] > r->last) r->last = p.at[TIME];
    return array_push(&r->alloc, &r->poses, p) ? FROE_OK : no_room(r);
}

static froe_status read_table(pose_reading *r, char *text) {
    const char separator = support_csv_separator(text);
    char *at = text;
    froe_status status = read_pose_header(r, &at, separator);
    while (!status && *at) {
        const char *blank = at + strspn(at, " \t\r");
        if (*blank != '\n' && *blank) {
            status = read_pose(r, &at, separator);
        } else {
            at += strcspn(at, "\n");
            at += *at == '\n';
            r->line++;
        }
    }
    if (!status && !r->poses.count)
        status = support_fail(r->diag, FROE_E_INPUT, "%s: There are no poses.", support_short(r->path));
    return status;
}

/* Rows by groups. */
static froe_status sort_poses(pose_reading *r) {
    const size_t groups = r->names.count, rows = r->poses.count;
    if (rows > UINT32_MAX / 2) return support_fail(r->diag, FROE_E_LIMIT, "There are more than 2^31 poses.");
    if (!array_reserve(&r->alloc, &r->starts, groups + 2) || !array_reserve(&r->alloc, &r->order, rows) ||
        !array_reserve(&r->alloc, &r->body, groups))
        return no_room(r);
    size_t *starts = r->starts.data;
    memset(starts, 0, (groups + 2) * sizeof *starts);
    for (size_t i = 0; i < rows; i++) starts[r->poses.data[i].group + 2]++;
    for (size_t g = 2; g < groups + 2; g++) starts[g] += starts[g - 1];
    for (uint32_t i = 0; i < rows; i++) r->order.data[starts[r->poses.data[i].group + 1]++] = i;
    return FROE_OK;
}

/* --------------------------------------------------------------------- bodies -- */

static const pose *pose_of(const pose_reading *r, size_t i) {
    return r->poses.data + r->order.data[i];
}

/* Has a part of the plane one height all the time, and does it turn about no other line than an upright one? */
static froe_status stays_in_plane(const pose_reading *r, uint32_t group) {
    const double *before = pose_of(r, r->starts.data[group])->at;
    for (size_t i = r->starts.data[group]; i < r->starts.data[group + 1]; i++)
        for (int k = TIME; k < COLUMNS; k++) {
            const double *at = pose_of(r, i)->at, expected = k == PLACE + 2 ? before[k] : 0;
            if (!is_read(r, k) && at[k] != expected)
                return support_fail(
                    r->diag, FROE_E_INPUT,
                    "%s: part '%.60s': At the time %.17g its %s is %.17g and not %.17g, and the model is "
                    "in the plane.",
                    support_short(r->path), froe_scene_group(r->model, group).name, at[TIME], column_names[k], at[k],
                    expected);
        }
    return FROE_OK;
}

static froe_status add_posed_part(pose_reading *r, uint32_t group) {
    const size_t first = r->starts.data[group], count = r->starts.data[group + 1] - first;
    froe_diagnostic why;
    const froe_status flat = stays_in_plane(r, group);
    if (flat) return flat;
    froe_body body = froe_body_defaults();
    const size_t dim = (size_t)dim_of(r), each = dim == 2 ? 2 : 4;
    r->numbers.count = 0;
    if (!array_reserve(&r->alloc, &r->numbers, 8 * count)) return no_room(r);
    double *times = r->numbers.data, *places = times + count, *turns = times + 4 * count;
    for (size_t i = 0; i < count; i++) {
        const pose *p = pose_of(r, first + i);
        times[i] = p->at[TIME];
        memcpy(places + dim * i, p->at + PLACE, dim * sizeof *places);
        memcpy(turns + each * i, p->at + COLUMNS - each, each * sizeof *turns);
    }
    body.count = count, body.times = times, body.coords = places, body.turns = turns;
    const froe_status status = froe_motion_add_body(r->motion, &body, &r->body.data[group], &why);
    if (status == FROE_E_MEMORY) return no_room(r);
    r->report.features++;
    r->report.pieces += count - 1;
    return !status ? FROE_OK
                   : support_fail(r->diag, status, "%s: part '%.60s': %s", support_short(r->path),
                                  froe_scene_group(r->model, group).name, why.message);
}

/* A body for what has no poses, and one for each part that has. */
static froe_status add_parts(pose_reading *r) {
    static const double origin[3], now[1];
    froe_body rest = froe_body_defaults();
    uint32_t still;
    rest.count = 1, rest.times = now, rest.coords = origin;
    froe_status status = froe_motion_add_body(r->motion, &rest, &still, r->diag);
    for (uint32_t g = 0; g < r->names.count && !status; g++) {
        r->body.data[g] = still;
        if (r->starts.data[g + 1] > r->starts.data[g])
            status = add_posed_part(r, g);
        else
            r->report.still++;
    }
    r->body.count = r->names.count;
    return status;
}

/* The triangles or segments of all parts. Those without a name are of the body that stands still. */
static froe_status add_objects(pose_reading *r) {
    const size_t groups = r->names.count, objects = froe_scene_object_count(r->model);
    if (!array_reserve(&r->alloc, &r->lives, groups + 1) || !array_reserve(&r->alloc, &r->each, groups + 2) ||
        !array_reserve(&r->alloc, &r->parts, objects))
        return no_room(r);
    for (size_t g = 0; g <= groups; g++) {
        const size_t first = g < groups ? r->starts.data[g] : 0, end = g < groups ? r->starts.data[g + 1] : 0;
        const bool moves = end > first + 1;
        r->each.data[g] = g;
        r->lives.data[g] = (formats_life){.body = g < groups ? r->body.data[g] : 0,
                                          .birth = moves ? pose_of(r, first)->at[TIME] : -(double)INFINITY,
                                          .death = moves ? pose_of(r, end - 1)->at[TIME] : (double)INFINITY};
    }
    r->each.data[groups + 1] = groups + 1;
    for (uint32_t i = 0; i < objects; i++) {
        const uint32_t group = froe_scene_object(r->model, i).group;
        r->parts.data[i] = group == FROE_NONE ? (uint32_t)groups : group;
    }
    const formats_bodies bodies = {r->each.data, r->lives.data, r->parts.data};
    froe_diagnostic why;
    const froe_status status = formats_add_bodies(r->motion, r->model, &bodies, &r->alloc, &why);
    if (status == FROE_E_MEMORY) return support_fail_memory(r->diag);
    if (status) return support_fail(r->diag, status, "%s: in the model: %s", support_short(r->path), why.message);
    return FROE_OK;
}

/* Is a part in the window that moves? Or does none move at all, so that there is nothing to miss? */
static bool shows_motion(const pose_reading *r, const froe_motion_options *window) {
    bool moves = false;
    for (size_t g = 0; g < r->names.count; g++) {
        const size_t first = r->starts.data[g], end = r->starts.data[g + 1];
        if (end <= first + 1) continue;
        moves = true;
        if (pose_of(r, first)->at[TIME] <= window->end && pose_of(r, end - 1)->at[TIME] >= window->begin) return true;
    }
    return !moves;
}

static froe_status make_motion(pose_reading *r, const froe_motion_read_options *o) {
    froe_diagnostic why;
    froe_motion_options w = froe_motion_defaults();
    w.dim = (unsigned)dim_of(r);
    if (r->first == r->last && isnan(o->from) && isnan(o->to))
        return support_fail(r->diag, FROE_E_INPUT, "%s: All of the file is at one instant, %.17g.",
                            support_short(r->path), r->first);
    w.begin = isnan(o->from) ? r->first : o->from;
    w.end = isnan(o->to) ? r->last : o->to;
    froe_status status = froe_motion_new(&w, o->alloc, &r->motion, &why);
    if (status == FROE_E_MEMORY) return no_room(r);
    if (status) return support_fail(r->diag, status, "%s: %s", support_short(r->path), why.message);
    status = sort_poses(r);
    if (!status) status = add_parts(r);
    if (!status && !shows_motion(r, &w))
        return support_fail(r->diag, FROE_E_INPUT,
                            "%s: No part moves from %.17g to %.17g. All rows are from %.17g to %.17g.",
                            support_short(r->path), w.begin, w.end, r->first, r->last);
    return status ? status : add_objects(r);
}

static void free_reading(pose_reading *r) {
    const froe_allocator *alloc = &r->alloc;
    array_free(alloc, &r->poses), array_free(alloc, &r->names), array_free(alloc, &r->starts);
    array_free(alloc, &r->order), array_free(alloc, &r->body), array_free(alloc, &r->numbers);
    array_free(alloc, &r->lives), array_free(alloc, &r->each), array_free(alloc, &r->parts);
}

froe_status froe_read_poses(const char *path, const froe_scene *model, const froe_motion_read_options *options,
                            froe_motion **out, froe_motion_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_motion_read_options standard = froe_motion_read_defaults();
    if (!path || !model || !out) return support_fail_null(diag, __func__);
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_motion_read_defaults");
    if (froe_scene_dim(model) > 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "%s: The model is not of the plane or of space.",
                            support_short(path));
    const froe_status checked = froe_scene_check(model, diag);
    if (checked) return checked;
    if (!options) options = &standard;
    const double start = formats_seconds();
    pose_reading r = {.path = path, .model = model, .alloc = support_allocator(options->alloc), .diag = diag};
    r.first = (double)INFINITY, r.last = -(double)INFINITY;
    formats_text text = {0};
    support_locale locale;
    froe_status status = formats_load_motion(path, &r.alloc, &text, diag);
    if (!status) status = name_parts(&r);
    if (!status && !support_locale_enter(&locale)) status = no_room(&r);
    if (!status) {
        status = read_table(&r, text.data);
        support_locale_leave(&locale);
    }
    if (!status) status = make_motion(&r, options);
    array_free(&r.alloc, &text);
    free_reading(&r);
    if (status) {
        froe_motion_free(r.motion);
        return status;
    }
    r.report.up = froe_scene_dim(model) == 3 ? froe_scene_up(model) : 2;
    r.report.seconds = formats_seconds() - start;
    if (report) *report = r.report;
    *out = r.motion;
    return FROE_OK;
}
