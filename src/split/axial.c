/* axial.c: see axial.h. */
#include "split/axial.h"
#include "base/log2.h"

/* As many candidates as refinement takes below other stages: see density.c. */
split_axial split_axial_of(const froe_scene *scene, uint32_t leaf, uint64_t seed, double growth) {
    bool plane = scene->dim == 2;
    split_refine refine = {.leaf = leaf,
                           .seed = seed,
                           .supports = plane ? 8 : 20,
                           .quantiles = plane ? 3 : 10,
                           .edges = 20,
                           .sample = 512,
                           .weight = 0.1,
                           .copy = 0.5,
                           .height = 2 * base_log2(scene->object_count + 2.0),
                           .free_cuts = true};
    return (split_axial){refine, growth};
}

bool split_axial_over(const split_axial *axial, const split_cell *cell) {
    return cell->count <= axial->refine.leaf || cell->attempt || cell->growth >= axial->growth;
}
