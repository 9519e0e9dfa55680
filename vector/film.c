/* film.c: froe_film: triangles in motion as an animated picture, instant by instant. */
#include "film.h"
#include "film_corners.h"
#include "film_instants.h"
#include "support/axes.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/path.h"
#include "support/writer.h"
#include <froe/formats.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void froe_film_defaults_into(froe_film_options *out, size_t size) {
    const froe_film_options all = {.size = size, .frames = 200, .seconds = 8, .halvings = 4};
    support_defaults(out, size, &all, sizeof all);
}

typedef struct film_work {
    const froe_motion *motion;
    froe_render_options options;
    froe_film_options film;
    froe_allocator alloc;
    froe_diagnostic *diag;
    double begin, end;
    froe_camera *cameras;
    size_t camera_count;
    film_list list;
    ARRAY(film_picture) waiting; /* to be shown, the next one last */
    ARRAY(double) times;         /* that are shown whatever they show */
    film_instants instants;      /* exact films only */
    film_turn turn;              /* of these, where the eye goes around */
    bool still;                  /* only the eye moves */
    froe_tree *tree;             /* then, of all pictures; NULL: none was needed yet */
    film_picture last;           /* what is shown */
    double passed, soon;         /* exact films: the last frame; so long after an instant its picture is taken */
    bool any;                    /* it is one */
    froe_film_report report;
} film_work;

static froe_status no_room(const film_work *w) {
    return support_fail_memory(w->diag);
}

/* ---------------------------------------------------------------------- cameras -- */

froe_status froe_film_cameras(const froe_motion *motion, const froe_camera *camera, bool turn, size_t count,
                              froe_camera *cameras, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!motion || !camera || !cameras || !count) return support_fail_null(diag, __func__);
    if (camera->size != sizeof *camera) return support_fail_defaults(diag, "froe_camera_defaults");
    if (froe_motion_window(motion).dim != 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "The motion is of the plane, and has no hidden surfaces.");
    for (size_t i = 0; i < count; i++) cameras[i] = *camera;
    if (!camera->fit && !turn) return FROE_OK;
    froe_scene *scene = NULL;
    froe_status status = vector_film_corners(motion, &scene, diag);
    if (!status) status = froe_camera_turn(camera, scene, turn ? count : 1, cameras, diag);
    for (size_t i = 1; i < count && !turn; i++) cameras[i] = cameras[0];
    froe_scene_free(scene);
    return status;
}

/* --------------------------------------------------------------------- pictures -- */

typedef struct path_keeper {
    film_work *work;
    film_picture *picture;
    size_t begun;
    bool full;
} path_keeper;

static bool keep_bytes(void *user, const void *bytes, size_t count) {
    path_keeper *k = user;
    k->full |= !array_append(&k->work->alloc, &k->picture->bytes, (const char *)bytes, count);
    return !k->full;
}

static bool keep_path(void *user, bool lines) {
    path_keeper *k = user;
    film_path path = {.at = k->begun, .length = k->picture->bytes.count - k->begun, .hash = 14695981039346656037u};
    for (size_t i = 0; i < path.length; i++) /* Fowler, Noll and Vo */
        path.hash = (path.hash ^ (unsigned char)k->picture->bytes.data[path.at + i]) * 1099511628211u;
    k->begun = k->picture->bytes.count;
    k->full |= !array_push(&k->work->alloc, &k->picture->paths[lines], path);
    return !k->full;
}

static void free_picture(film_picture *p, const froe_allocator *alloc) {
    array_free(alloc, &p->bytes), array_free(alloc, &p->seen);
    for (int kind = 0; kind < 2; kind++) array_free(alloc, &p->paths[kind]);
}

static int compare_tags(const void *a, const void *b) {
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/* The objects of all patches of which something is visible, by their shapes, or where there are none by their lines. */
static bool note_seen(const vector_render *r, film_picture *p, const froe_allocator *alloc) {
    bool room = true;
    for (size_t i = 0; i < froe_picture_shape_count(r->picture) && room; i++) {
        const froe_patch patch = froe_surface_patch(r->surface, froe_picture_shape(r->picture, i).patch);
        for (size_t k = 0; k < patch.object_count && room; k++)
            room = array_push(alloc, &p->seen, froe_scene_object(r->scene, patch.objects[k]).tag);
    }
    for (size_t i = 0; i < froe_picture_stroke_count(r->picture) && room && !r->report.shapes; i++) {
        const froe_stroke stroke = froe_picture_stroke(r->picture, i);
        if (!stroke.hidden) room = array_push(alloc, &p->seen, froe_scene_object(r->scene, stroke.objects[0]).tag);
    }
    size_t kept = 0;
    if (p->seen.count) qsort(p->seen.data, p->seen.count, sizeof *p->seen.data, compare_tags);
    for (size_t i = 0; i < p->seen.count; i++)
        if (!kept || p->seen.data[i] != p->seen.data[kept - 1]) p->seen.data[kept++] = p->seen.data[i];
    p->seen.count = kept;
    return room;
}

static froe_camera camera_at(const film_work *w, double time) {
    if (w->film.turn && w->film.exact) return film_turn_at(&w->turn, time);
    const double share = (time - w->begin) / (w->end - w->begin);
    const size_t camera = (size_t)(share * (double)w->camera_count);
    return w->cameras[camera < w->camera_count ? camera : w->camera_count - 1];
}

static froe_status draw_tree(film_work *w, const froe_tree *tree, film_picture *p) {
    path_keeper keeper = {.work = w, .picture = p};
    vector_output output = {.fn = keep_bytes, .user = &keeper};
    vector_render r = {.tree = tree, .scene = froe_tree_scene(tree), .options = &w->options};
    const froe_camera camera = camera_at(w, p->time);
    r.grid = vector_grid(&w->options, FROE_RENDER_SVG);
    froe_status status = vector_prepare(&r, &camera, w->diag);
    if (!status && !note_seen(&r, p, &w->alloc)) status = no_room(w);
    if (!status) vector_svg_each(&r, &output, keep_path, &keeper);
    if (!status && (keeper.full || output.status)) status = no_room(w);
    vector_free(&r);
    return status;
}

/* The tree of an instant, or of all; NULL: nothing is there. */
static froe_status grow_tree(film_work *w, double time, froe_tree **tree) {
    froe_scene *scene = NULL;
    froe_build_options o = froe_build_defaults();
    o.purpose = "draw", o.threads = 1;
    *tree = w->tree;
    if (*tree) return FROE_OK;
    froe_status status = froe_motion_scene(w->motion, time, &w->alloc, &scene, w->diag);
    if (!status && froe_scene_object_count(scene)) status = froe_build(scene, &o, tree, w->diag);
    froe_scene_free(scene);
    if (w->still) w->tree = *tree;
    return status;
}

/* The picture of an instant. What fails leaves nothing behind. */
static froe_status draw_instant(film_work *w, double time, bool exact, film_picture *out) {
    froe_tree *tree = NULL;
    *out = (film_picture){.time = time, .exact = exact};
    froe_status status = grow_tree(w, time, &tree);
    if (!status && tree) status = draw_tree(w, tree, out);
    if (!w->still) froe_tree_free(tree);
    if (status) free_picture(out, &w->alloc);
    w->report.pictures++;
    return status;
}

/* ------------------------------------------------------------------------- time -- */

static bool same_seen(const film_picture *a, const film_picture *b) {
    return a->seen.count == b->seen.count &&
           (!a->seen.count || !memcmp(a->seen.data, b->seen.data, a->seen.count * sizeof *a->seen.data));
}

/* Shows a picture, which becomes the last. */
static froe_status show(film_work *w, film_picture *picture) {
    const bool room = vector_film_show(&w->list, picture, (picture->time - w->begin) / (w->end - w->begin), &w->alloc);
    free_picture(&w->last, &w->alloc);
    w->last = *picture, w->any = true;
    w->report.shown++;
    return room ? FROE_OK : no_room(w);
}

/* Goes on to a time that is shown; where other faces are seen then, also to what is between. */
static froe_status go_to(film_work *w, double time, double least) {
    film_picture next;
    froe_status status = draw_instant(w, time, true, &next);
    if (status || !w->any) return status ? status : show(w, &next);
    w->report.changes += !same_seen(&w->last, &next);
    if (!array_push(&w->alloc, &w->waiting, next)) return free_picture(&next, &w->alloc), no_room(w);
    double from = w->last.time; /* the faces of the last picture are seen so long */
    while (!status && w->waiting.count) {
        film_picture *first = w->waiting.data + w->waiting.count - 1;
        const bool same = same_seen(&w->last, first);
        const double middle = 0.5 * from + 0.5 * first->time;
        if (!same && first->time - from > 1.5 * least && middle > from && middle < first->time) {
            status = draw_instant(w, middle, false, &next);
            if (!status && !array_push(&w->alloc, &w->waiting, next))
                free_picture(&next, &w->alloc), status = no_room(w);
            continue;
        }
        next = *first;
        w->waiting.count--;
        from = next.time;
        if (same && !next.exact)
            free_picture(&next, &w->alloc);
        else
            status = show(w, &next);
    }
    return status;
}

/* When the picture after an instant is taken; at.high itself: no double is between it and the next instant. */
static double soon_after(const film_work *w, film_instant at, double next) {
    const double now = at.high + fmin(0.5 * (next - at.high), w->soon);
    if (now > at.high) return now;
    const double later = nextafter(at.high, INFINITY); /* far from 0 `soon` is less than that */
    return later < next ? later : at.high;
}

/* The picture just after an instant, before anything else happens. *same: its faces are those of the last picture,
 * whose list of instants goes on to hold; otherwise a list is made of those that follow while the new ones are in
 * sight. */
static froe_status look_after(film_work *w, film_instant at, double next, double time, film_picture *out, bool *same) {
    double now = soon_after(w, at, next);
    film_instant after;
    for (bool renewed = false;; renewed = true) {
        froe_status status = draw_instant(w, now, true, out);
        if (status) return status;
        *same = same_seen(&w->last, out);
        if (*same && !renewed) return FROE_OK;
        const film_picture *seen = *same ? &w->last : out;
        status = film_instants_find(&w->instants, seen->seen.data, seen->seen.count, at.high, time, w->diag);
        if (status) return free_picture(out, &w->alloc), status;
        if (!film_instants_next(&w->instants, at.high, now, &after, &next)) return FROE_OK;
        const double sooner = 0.5 * at.high + 0.5 * after.low;
        if (!(sooner > at.high && sooner < now)) return FROE_OK; /* no double is between */
        free_picture(out, &w->alloc);
        now = sooner;
    }
}

/* Goes on to a time, which is shown unless the film ends then, and looks after each instant before it at which other
 * faces may come into sight. */
static froe_status go_exactly(film_work *w, double time) {
    film_picture picture;
    film_instant at;
    double passed = -INFINITY, next;
    bool same;
    froe_status status = FROE_OK;
    if (w->any)
        status = film_instants_find(&w->instants, w->last.seen.data, w->last.seen.count, w->passed, time, w->diag);
    while (!status && w->any && film_instants_next(&w->instants, passed, time, &at, &next)) {
        passed = at.high;
        if (!(soon_after(w, at, next) > at.high)) continue; /* together with the next */
        status = look_after(w, at, next, time, &picture, &same);
        if (status) break;
        w->report.late = fmax(w->report.late, at.high - at.low);
        w->report.changes += !same;
        picture.time = at.high;
        if (same)
            free_picture(&picture, &w->alloc);
        else
            status = show(w, &picture);
    }
    w->passed = time;
    if (status || time == w->end) return status;
    status = draw_instant(w, time, true, &picture);
    return status ? status : show(w, &picture);
}

static int compare_instants(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Frames, and instants at which something appears or ends. */
static froe_status list_times(film_work *w) {
    bool room = true;
    for (uint32_t i = 0; i < w->film.frames && room; i++) {
        const double share = (double)i / w->film.frames, time = w->begin * (1 - share) + w->end * share;
        room = array_push(&w->alloc, &w->times, time);
    }
    for (uint32_t i = 0; i < froe_motion_object_count(w->motion) && room; i++) {
        const froe_moving_object o = froe_motion_object(w->motion, i);
        const double ends[] = {o.birth, o.death};
        for (int k = 0; k < 2 && room && o.birth <= o.death; k++)
            if (ends[k] > w->begin && ends[k] < w->end) room = array_push(&w->alloc, &w->times, ends[k]);
    }
    if (!room) return no_room(w);
    qsort(w->times.data, w->times.count, sizeof *w->times.data, compare_instants);
    return FROE_OK;
}

static froe_status begin_exactly(film_work *w) {
    froe_scene *scene = NULL;
    froe_status status = vector_film_corners(w->motion, &scene, w->diag);
    if (!status) status = film_instants_begin(&w->instants, w->motion, w->cameras, scene, &w->options, w->diag);
    froe_scene_free(scene);
    if (status || !w->film.turn) return status;
    w->instants.turn = &w->turn;
    return film_turn_begin(&w->turn, w->cameras, &w->instants.view, w->camera_count, w->begin, w->end, &w->alloc,
                           w->diag);
}

/* Is all there all the time, where it is? */
static bool is_still(const film_work *w) {
    bool still = true;
    for (uint32_t v = 0; v < froe_motion_vertex_count(w->motion) && still; v++) {
        const uint32_t body = froe_motion_vertex_body(w->motion, v);
        still = body == FROE_NONE ? froe_motion_knot_count(w->motion, v) == 1
                                  : froe_motion_body_knot_count(w->motion, body) == 1;
    }
    for (uint32_t i = 0; i < froe_motion_object_count(w->motion) && still; i++) {
        const froe_moving_object o = froe_motion_object(w->motion, i);
        still = o.birth == w->begin && o.death == w->end;
    }
    return still;
}

static froe_status make_film(film_work *w) {
    const double least = (w->end - w->begin) / w->film.frames / (double)(1u << w->film.halvings);
    const size_t count = !w->film.turn   ? 1
                         : w->film.exact ? film_turn_places(w->film.frames)
                                         : (size_t)w->film.frames << w->film.halvings;
    froe_status status = list_times(w);
    if (status) return status;
    w->cameras = support_calloc(&w->alloc, count, sizeof *w->cameras);
    if (!w->cameras) return no_room(w);
    w->camera_count = count, w->report.late = w->film.exact ? 0 : least;
    w->soon = least / 1024, w->still = is_still(w);
    status = froe_film_cameras(w->motion, &w->options.camera, w->film.turn, count, w->cameras, w->diag);
    if (!status && w->film.exact) status = begin_exactly(w);
    for (size_t i = 0; i < w->times.count && !status; i++)
        if (!i || w->times.data[i] > w->times.data[i - 1])
            status = w->film.exact ? go_exactly(w, w->times.data[i]) : go_to(w, w->times.data[i], least);
    if (!status && w->film.exact) status = go_exactly(w, w->end);
    return status;
}

/* ---------------------------------------------------------------------- options -- */

static froe_status check_film(film_work *w, const froe_film_options *film) {
    if (froe_motion_window(w->motion).dim != 3)
        return support_fail(w->diag, FROE_E_UNSUPPORTED, "The motion is of the plane, and has no hidden surfaces.");
    if (film->frames < 1 || film->frames > 1000000)
        return support_fail(w->diag, FROE_E_OPTIONS, "option 'frames': '%u' is not from 1 to 1000000.", film->frames);
    if (film->halvings > 20)
        return support_fail(w->diag, FROE_E_OPTIONS, "option 'halvings': '%u' is above 20.", film->halvings);
    if (!(film->seconds > 0 && film->seconds <= 1e6))
        return support_fail(w->diag, FROE_E_OPTIONS, "option 'seconds': '%g' is not a number above 0 and up to 1e6.",
                            film->seconds);
    if (w->options.layers || w->options.interleaved || w->options.seams == FROE_SEAMS_TWICE)
        return support_fail(w->diag, FROE_E_OPTIONS,
                            "A film has no layers, no interleaved lines and no fills that are painted twice.");
    froe_scene *scene = NULL; /* with the groups, which options are about */
    froe_status status = froe_motion_scene(w->motion, w->begin, &w->alloc, &scene, w->diag);
    if (!status) status = vector_check_format(scene, &w->options, FROE_RENDER_SVG, w->diag);
    froe_scene_free(scene);
    return status;
}

static void free_film(film_work *w) {
    for (size_t i = 0; i < w->waiting.count; i++) free_picture(w->waiting.data + i, &w->alloc);
    free_picture(&w->last, &w->alloc);
    array_free(&w->alloc, &w->waiting), array_free(&w->alloc, &w->times);
    vector_film_free(&w->list, &w->alloc);
    film_instants_end(&w->instants);
    film_turn_end(&w->turn);
    froe_tree_free(w->tree);
    if (w->cameras) support_free(&w->alloc, w->cameras, w->camera_count * sizeof *w->cameras);
}

froe_status froe_film_write(const froe_motion *motion, froe_write_fn *fn, void *user,
                            const froe_render_options *options, const froe_film_options *film, froe_film_report *report,
                            froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_film_options standard = froe_film_defaults();
    vector_output output = {.fn = fn, .user = user};
    if (!motion || !fn) return support_fail_null(diag, __func__);
    if (film && film->size != sizeof *film) return support_fail_defaults(diag, "froe_film_defaults");
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_render_defaults");
    film_work w = {.motion = motion, .film = film ? *film : standard, .diag = diag};
    w.options = options ? *options : froe_render_defaults();
    w.options.ids = FROE_IDS_OBJECT;
    w.alloc = support_allocator(w.options.alloc);
    w.begin = froe_motion_window(motion).begin, w.end = froe_motion_window(motion).end;
    froe_status status = check_film(&w, &w.film);
    if (!status) status = make_film(&w);
    if (!status) {
        const vector_render r = {.options = &w.options};
        vector_svg_begin(&r, &output);
        w.report.paths = vector_film_put(&w.list, w.film.seconds, &output);
        vector_svg_end(&r, &output);
        status = vector_end(&output, diag);
        w.report.bytes = output.count;
    }
    free_film(&w);
    if (!status && report) *report = w.report;
    return status;
}

static bool put_to_film(void *user, const void *bytes, size_t count) {
    support_writer_put(user, bytes, count);
    return true;
}

froe_status froe_film(const froe_motion *motion, const char *path, const froe_render_options *options,
                      const froe_film_options *film, froe_film_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    support_writer file;
    if (!motion || !path) return support_fail_null(diag, __func__);
    if (strcmp(support_path_extension(path).text, "svg") != 0)
        return support_fail_ending(diag, FROE_E_OPTIONS, path, "animations", ".svg");
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_render_defaults");
    froe_status status = support_writer_open(&file, path, options ? options->alloc : NULL, diag);
    if (status) return status;
    status = froe_film_write(motion, put_to_film, &file, options, film, report, diag);
    return support_writer_close(&file, status);
}
