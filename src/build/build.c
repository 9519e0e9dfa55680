/* build.c: froe_build: checks the request, finds the method and runs it. */
#include "base/floats.h"
#include "build/options.h"
#include "support/fail.h"
#include "support/locale.h"
#include "tree/gate.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FROE_METHOD(name) extern const build_method build_method_##name;
#include "build/methods.def"
#undef FROE_METHOD

static const build_method *const methods[] = {
#define FROE_METHOD(name) &build_method_##name,
#include "build/methods.def"
#undef FROE_METHOD
};
enum { METHOD_COUNT = sizeof methods / sizeof *methods };

const froe_method_info *froe_method_at(size_t i) {
    return i < METHOD_COUNT ? &methods[i]->info : NULL;
}

void froe_build_defaults_into(froe_build_options *out, size_t size) {
    const froe_build_options all = {
        .size = size, .method = "auto", .purpose = "pieces", .leaf = FROE_LEAF_OWN, .seed = 1};
    support_defaults(out, size, &all, sizeof all);
}

split_job build_split_job(const build_job *job) {
    return (split_job){.scene = job->scene,
                       .alloc = job->alloc,
                       .task = job->task,
                       .max_fragments = job->max_fragments,
                       .root = job->root,
                       .span = 0.9 * (1 - job->task->done),
                       .meta = &job->meta,
                       .first = job->first,
                       .diag = job->diag};
}

void build_promise(build_job *job, const char *name, double promised, double measured) {
    tree_promise *p = job->meta.promises + job->meta.promise_count++;
    snprintf(p->name, sizeof p->name, "%s", name);
    p->promised = promised;
    p->measured = measured;
}

/** Bits of the kinds the scene holds. */
static uint32_t kinds_of(const froe_scene *scene) {
    uint32_t kinds = 0;
    for (uint32_t i = 0; i < scene->object_count; i++) kinds |= 1u << scene_kind(scene, i);
    return kinds;
}

static const build_method *find_method(const char *name) {
    for (size_t i = 0; i < METHOD_COUNT; i++)
        if (!strcmp(methods[i]->info.name, name)) return methods[i];
    return NULL;
}

/* Grain takes about 40 us a segment, eight to fifteen times as long as density, for a tenth fewer pieces. */
enum { SEGMENTS_FOR_GRAIN = 1 << 16 };

/** Grain has the fewest pieces of polygons, and of segments where these are not too many; queries gain nothing. */
static bool suits_grain(const froe_scene *scene, uint32_t kinds) {
    const uint32_t point = 1u << FROE_POINT, segment = 1u << FROE_SEGMENT, polygon = 1u << FROE_POLYGON;
    if (scene->dim == 2)
        return kinds & segment && !(kinds & ~(point | segment)) && scene->object_count <= SEGMENTS_FOR_GRAIN;
    return scene->dim == 3 && kinds & polygon && !(kinds & ~(point | segment | polygon));
}

static bool is_auto(const froe_build_options *o) {
    return !o->method || !strcmp(o->method, "auto");
}

/** Is it for pictures in space? */
static bool draws_space(const froe_scene *scene, const char *purpose) {
    return scene->dim == 3 && purpose && !strcmp(purpose, "draw");
}

/** What "auto" stands for: it serves every dimension and kind. Index answers queries several times faster, where it
 * serves. Directional has the fewest pieces of boxes, and is no slower. In space, density and one picture together take
 * a third to two thirds of the time that grain and the same picture take. (See docs/reference/compare.md.) */
const char *froe_method_auto(const froe_scene *scene, const char *purpose) {
    const bool query = purpose && !strcmp(purpose, "query");
    const bool known = !purpose || query || !strcmp(purpose, "pieces") || !strcmp(purpose, "draw");
    if (!scene || !known || scene_settle(scene, NULL)) return NULL;
    const uint32_t kinds = kinds_of(scene);
    if (query && froe_method_serves(&find_method("index")->info, scene, FROE_LEAF_OWN)) return "index";
    if (kinds == 1u << FROE_POINT && query) return "kd"; /* four times as fast as density in dimension 8 */
    if (kinds == 1u << FROE_BOX) return "directional";
    return !query && !draws_space(scene, purpose) && suits_grain(scene, kinds) ? "grain" : "density";
}

static froe_status choose_method(const froe_build_options *o, const froe_scene *scene, const build_method **out,
                                 froe_diagnostic *diag) {
    const char *best = froe_method_auto(scene, o->purpose), *name = is_auto(o) ? best : o->method;
    if (!best)
        return support_fail(diag, FROE_E_OPTIONS, "There is no purpose '%s'. There are: pieces, query, draw.",
                            o->purpose);
    *out = find_method(name);
    if (*out) return FROE_OK;
    char list[160] = "auto";
    for (size_t i = 0; i < METHOD_COUNT; i++) {
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, ", %s", methods[i]->info.name);
    }
    return support_fail(diag, FROE_E_OPTIONS, "There is no method '%s'. There are: %s.", name, list);
}

static uint32_t leaf_of(const froe_method_info *info, uint32_t leaf) {
    return leaf != FROE_LEAF_OWN ? leaf : info->leaf ? info->leaf : 1;
}

bool froe_method_serves(const froe_method_info *method, const froe_scene *scene, uint32_t leaf) {
    if (!method || !scene || scene_settle(scene, NULL)) return false;
    uint32_t kinds = kinds_of(scene), capacity = leaf_of(method, leaf);
    /* leaf 0: every object ends in a cut */
    uint32_t kinds_in_cuts = scene->dim == 2 ? 1u << FROE_SEGMENT : scene->dim == 3 ? 1u << FROE_POLYGON : 0;
    return method->kinds[scene->dim] && !(kinds & ~method->kinds[scene->dim]) && capacity >= method->least_leaf &&
           (capacity || !(kinds & ~kinds_in_cuts));
}

/* Says why a method does not serve. */
static froe_status check_scene(const build_method *method, const froe_scene *scene, uint32_t leaf,
                               froe_diagnostic *diag) {
    const froe_method_info *info = &method->info;
    uint32_t kinds = kinds_of(scene), alien = kinds & ~info->kinds[scene->dim];
    if (froe_method_serves(info, scene, leaf)) return FROE_OK;
    if (!info->kinds[scene->dim])
        return support_fail(diag, FROE_E_UNSUPPORTED, "Method '%s' does not serve dimension %d.", info->name,
                            scene->dim);
    if (alien)
        return support_fail(diag, FROE_E_UNSUPPORTED,
                            "Method '%s' does not serve objects of kind '%s' in dimension %d.", info->name,
                            froe_kind_name((froe_kind)__builtin_ctz(alien)), scene->dim);
    if (leaf < info->least_leaf)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Method '%s' needs a leaf capacity of %u at least.", info->name,
                            info->least_leaf);
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "A leaf capacity of 0 is for scenes of segments in the plane or of polygons in space only.");
}

/** Is it an order of all objects, for a method that takes one? */
static froe_status check_order(const froe_build_options *o, const build_method *method, const froe_scene *scene,
                               froe_diagnostic *diag) {
    size_t n = scene->object_count;
    if (!o->order && !o->order_count) return FROE_OK;
    if (!method->ordered)
        return support_fail(diag, FROE_E_OPTIONS, "Method '%s' takes no order of objects.", method->info.name);
    if (!o->order || o->order_count != n)
        return support_fail(diag, FROE_E_OPTIONS, "The order has %zu entries for %zu objects.",
                            o->order ? o->order_count : 0, n);
    bool *seen = support_calloc(&scene->alloc, n, sizeof *seen);
    if (!seen) return support_fail_memory(diag);
    froe_status status = FROE_OK;
    for (size_t i = 0; i < n && !status; i++) {
        uint32_t id = o->order[i];
        if (id >= n)
            status =
                support_fail(diag, FROE_E_OPTIONS, "Entry %zu of the order is %u, and there is no such object.", i, id);
        else if (seen[id])
            status = support_fail(diag, FROE_E_OPTIONS, "The order has object %u twice.", id);
        else
            seen[id] = true;
    }
    support_free(&scene->alloc, seen, n ? n * sizeof *seen : 1);
    return status;
}

/** In the C locale: a decimal comma would make settings invalid, or get into trees. */
static froe_status prepare_in_any_locale(const froe_build_options *o, const build_method *method, bool tuned,
                                         build_job *job) {
    support_locale locale;
    if (!support_locale_enter(&locale)) return support_fail_memory(job->diag);
    const froe_status status = options_parse(method, o->settings, tuned, job->option, job->diag);
    if (!status) {
        if (method->resolve) method->resolve(job->scene, o->leaf, job->option);
        snprintf(job->meta.method, sizeof job->meta.method, "%s", method->info.name);
        options_print(method, job->option, job->meta.settings, sizeof job->meta.settings);
        job->meta.leaf = job->leaf = o->leaf;
        job->meta.seed = job->seed = o->seed;
        job->max_fragments = o->max_fragments;
        job->order = o->order;
    }
    support_locale_leave(&locale);
    return status;
}

static froe_status build_by_method(froe_scene *scene, const froe_build_options *options, bool tuned,
                                   const froe_cut *root, froe_tree **out, froe_diagnostic *diag) {
    const build_method *method;
    base_task task;
    if (!scene || !out) return support_fail_null(diag, "froe_build");
    froe_build_options o = options ? *options : froe_build_defaults();
    if (o.size != sizeof o) return support_fail_defaults(diag, "froe_build_defaults");
    if (o.leaf > INT32_MAX && o.leaf != FROE_LEAF_OWN)
        return support_fail(diag, FROE_E_OPTIONS, "A leaf capacity of %u is above %d, the largest there is.", o.leaf,
                            INT32_MAX);
    froe_status status = scene_settle(scene, diag);
    if (!status) status = choose_method(&o, scene, &method, diag);
    const bool own_leaf = o.leaf == FROE_LEAF_OWN;
    if (!status) o.leaf = leaf_of(&method->info, o.leaf);
    if (!status) status = check_scene(method, scene, o.leaf, diag);
    if (!status) status = check_order(&o, method, scene, diag);
    if (!status && root && !method->rooted)
        status = support_fail(diag, FROE_E_UNSUPPORTED, "Method '%s' takes no first cut.", method->info.name);
    if (status) return status;
    build_job job = {
        .scene = scene, .alloc = scene->alloc, .task = &task, .diag = diag, .root = root, .own_leaf = own_leaf};
    job.picture = is_auto(&o) && draws_space(scene, o.purpose);
    base_task_init(&task, o.threads, o.progress, o.user);
    status = prepare_in_any_locale(&o, method, tuned, &job);
    if (!status && !base_progress(&task, 0)) status = support_fail_cancelled(diag);
    froe_tree *tree = NULL;
    if (!status) status = method->build(&job, &tree);
    if (!status && !base_progress(&task, 1)) {
        froe_tree_free(tree);
        status = support_fail_cancelled(diag);
    }
    if (!status) *out = tree;
    return status;
}

froe_status froe_build(froe_scene *scene, const froe_build_options *options, froe_tree **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    return build_by_method(scene, options, false, NULL, out, diag);
}

froe_status build_tuned(froe_scene *scene, const froe_build_options *options, froe_tree **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    return build_by_method(scene, options, true, NULL, out, diag);
}

froe_status froe_tree_section(const froe_tree *tree, const double *plane, const froe_build_options *options,
                              froe_tree **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!tree || !plane || !out) return support_fail_null(diag, __func__);
    const int dim = tree->scene->dim;
    froe_build_options o = options ? *options : froe_build_defaults();
    double most = 0;
    if (dim > 3) return support_fail(diag, FROE_E_UNSUPPORTED, "Sections exist in 2 and 3 dimensions, not in %d.", dim);
    for (int k = 0; k <= dim; k++) {
        if (!isfinite(plane[k]))
            return support_fail_at(diag, FROE_E_ARG, FROE_NONE, FROE_NONE, (uint32_t)k,
                                   "Number %d of the plane is %g, not a finite number.", k, plane[k]);
        if (k < dim) most = fmax(most, fabs(plane[k]));
    }
    if (!(most > 0)) return support_fail(diag, FROE_E_ARG, "The normal of the plane has length 0.");
    const froe_status settled = tree_settle(tree, diag);
    if (settled) return settled;
    const froe_cut root = {.kind = FROE_CUT_PLANE, .value = plane[dim], .normal = plane};
    o.method = tree->meta.method;
    o.settings = tree->meta.settings;
    o.leaf = tree->meta.leaf;
    o.seed = tree->meta.seed;
    return build_by_method(tree->scene, &o, false, &root, out, diag);
}
