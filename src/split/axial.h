/* axial.h: what builders share that begin with axis-parallel cuts: when that stage ends, and what comes then.
 *
 * The stage ends in cells that hold few enough objects, where no axis-parallel plane separates any, and where its cuts
 * have multiplied the objects: growth = product of (fragments after / fragments before) over the cuts above. The sum
 * over cells of fragments / growth never exceeds n, so that a stage that ends where growth reaches G makes at most
 * 2 G n fragments, whatever the scene. Each of its cuts leaves less than all of the cell on either side: it is finite.
 * The rest is cut along the objects (refine.h), or is a crowded or an inseparable leaf. */
#ifndef FROE_SPLIT_AXIAL_H
#define FROE_SPLIT_AXIAL_H
#include "split/refine.h"

typedef struct split_axial {
    split_refine refine;
    double growth;
} split_axial;

split_axial split_axial_of(const froe_scene *scene, uint32_t leaf, uint64_t seed, double growth);
/** Is the cell to be refined, or done? */
bool split_axial_over(const split_axial *axial, const split_cell *cell);
#endif
