/* paterson_yao.c: the deterministic partitions of Paterson and Yao.
 *
 *     slabs          segments of the plane: medians of the x of endpoints; where a segment crosses a slab, along it.
 *                    O(n log n) for n disjoint ones (Efficient binary space partitions for hidden-surface removal and
 *                    solid modeling, 1990). It converts a plan of vertical lines (build/conversion/convert.h).
 *     orthogonal     axis-parallel objects: a cut that divides nothing, if there is one, the best balanced; else,
 *                    across the axis with most ends to choose from, through the middle of them (Optimal binary space
 *                    partitions for orthogonal objects, 1992; Murali, Agarwal and Vitter: Constructing binary space
 *                    partitions for orthogonal rectangles in practice, 1998).
 *
 * Free cuts of the papers run through a facet that crosses its cell. In a cell of disjoint objects such a cut divides
 * nothing; that is the condition here, so gaps count, too. */
#include "build/conversion/endpoints.h"
#include "split/axial.h"
#include "support/fail.h"
#include <math.h>

enum { RULE, GROWTH };
enum { AUTO, SLABS, ORTHOGONAL };

static const char *const rules[] = {"auto", "slabs", "orthogonal", NULL};
static const froe_option_info options[] = {
    [RULE] = {"rule", "auto: slabs for segments in the plane of which one is not axis-parallel", AUTO, 0, 2, rules,
              true},
    [GROWTH] = {"growth",
                "fragments per fragment at which a cell is cut along its objects; 0: 4 where some are not "
                "axis-parallel, else no limit",
                0, 0, 1e9, NULL, false},
    {0},
};

/* ------------------------------------------------------------ the scene's kind -- */

/** Segments and polygons are when they lie in axis-parallel lines and planes; all other kinds are. */
static bool is_orthogonal(const froe_scene *s) {
    for (uint32_t i = 0; i < s->object_count; i++) {
        froe_kind form = scene_form(s, i);
        int most = form == FROE_SEGMENT ? 1 : form == FROE_POLYGON ? 2 : s->dim, extents = 0;
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        scene_object_bounds(s, i, lo, hi);
        for (int k = 0; k < s->dim; k++) extents += lo[k] < hi[k];
        if (extents > most) return false;
    }
    return true;
}

static bool has_segments_alone(const froe_scene *s) {
    for (uint32_t i = 0; i < s->object_count; i++)
        if (scene_form(s, i) != FROE_SEGMENT && scene_form(s, i) != FROE_POINT) return false;
    return s->dim == 2;
}

/* ------------------------------------------------------------------ orthogonal -- */

static split_verdict choose_orthogonal(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const split_axial *axial = config;
    split_axes *a = &((split_scratch *)work->scratch)->axes;
    froe_cut free_cut = {.kind = FROE_CUT_NONE}, middle = free_cut;
    uint32_t lightest = UINT32_MAX; /* heavier side of the best free cut; UINT32_MAX: there is none */
    uint32_t most = 0;              /* candidates on the axis of the middle cut; 0: there are none */
    if (split_axial_over(axial, cell)) return split_refine_choose(&axial->refine, work, cell, cut);
    for (int k = 0; k < work->set.scene->dim; k++) {
        froe_cut here = {.kind = FROE_CUT_AXIS, .axis = k}, evenest = here;
        uint32_t choice = 0, least = UINT32_MAX;
        if (!split_axes_fill(a, &work->set, cell, k)) return SPLIT_MEMORY;
        while (split_axes_next(a)) {
            const split_tally t = a->tally;
            if (!split_tally_useful(t) || !isfinite(a->value)) continue;
            uint32_t heavier = t.negative > t.positive ? t.negative : t.positive;
            uint32_t uneven = 2 * heavier - t.negative - t.positive;
            choice++;
            here.value = a->value;
            if (!t.both && heavier < lightest) lightest = heavier, free_cut = here;
            if (uneven < least) least = uneven, evenest = here;
        }
        if (choice > most) most = choice, middle = evenest;
    }
    if (!most) return split_refine_choose(&axial->refine, work, cell, cut);
    *cut = lightest < UINT32_MAX ? free_cut : middle;
    return SPLIT_CUT;
}

/* ----------------------------------------------------------------------- build -- */

static froe_status build_paterson_yao(build_job *job, froe_tree **out) {
    static const convert_plan slabs = {"kd", "axes=first", true};
    int rule = (int)job->option[RULE];
    bool segments = has_segments_alone(job->scene);
    if (rule == SLABS && !segments)
        return support_fail(job->diag, FROE_E_UNSUPPORTED,
                            "option 'rule=slabs': It is for segments and points of the plane only.");
    if (rule == AUTO) rule = segments && !is_orthogonal(job->scene) ? SLABS : ORTHOGONAL;
    if (rule == SLABS) return build_converted(job, &slabs, out);
    double growth = job->option[GROWTH] > 0 ? job->option[GROWTH] : is_orthogonal(job->scene) ? (double)INFINITY : 4;
    split_axial axial = split_axial_of(job->scene, job->leaf, job->seed, growth);
    split_method method = {.config = &axial,
                           .choose = choose_orthogonal,
                           .scratch_new = split_scratch_new,
                           .scratch_free = split_scratch_free};
    split_job split = build_split_job(job);
    return split_grow(&split, &method, out);
}

const build_method build_method_paterson_yao = {
    .info = {.name = "paterson_yao",
             .summary =
                 "deterministic: slabs for segments of the plane, free cuts and medians for axis-parallel objects",
             .source = "Paterson and Yao 1990, 1992; Murali, Agarwal and Vitter 1998",
             .guarantee = "slabs: O(n log n) fragments of disjoint segments; orthogonal: none",
             .kinds = BUILD_SERVES_ABOVE(BUILD_DIMS_ALL,
                                         1u << FROE_POINT | 1u << FROE_SEGMENT | 1u << FROE_POLYGON | 1u << FROE_BOX,
                                         1u << FROE_POINT | 1u << FROE_BOX),
             .options = options},
    .build = build_paterson_yao,
};
