/* motions.c: contacts of moving segments against whole numbers; partitions of them that change, against an oracle of
 * the present; partitions of moving triangles from event to event, against trees of where they are then. */
#include "kinetic/changing.h"
#include "support/found.h"

#include "kinetic/motions.h"
#include "soak.h"
#include "support/contacts.h"
#include "support/flights.h"

void soak_contacts(soak_block *block) {
    static motion_arrays arrays;
    fuzz_source r = {base_hash(block->seed, 5, 0)};
    for (int kind = 0; kind < MOTION_KINDS; kind++) {
        judged_contacts t = {0};
        const froe_moving batch = motion_make(&r, (motion_kind)kind, (size_t)fuzz_int(&r, 2, 6), &arrays);
        froe_motion *m = motion_of(&batch, NULL);
        judge_contacts(m, &t);
        block->decisions += t.pairs + t.contacts;
        froe_motion_free(m);
    }
}

void soak_plane(soak_block *block) {
    changing c = {.random = {base_hash(block->seed, 6, 0)}, .questions = 4};
    if (!changing_run(&c, 20)) soak_complain(block, "%s", c.all.why);
    const beside_counts *n = &c.all.counts;
    block->decisions += n->trees + n->locates + n->rays + n->pairs + n->snapshots + c.counts.audits;
}

void soak_space(soak_block *block) {
    const uint64_t which = block->seed % (SPACE_KINDS + FLIGHT_KINDS), seed = base_hash(block->seed, 7, 0) >> 16;
    const flight_kind *flight = which < SPACE_KINDS ? NULL : flight_kinds + (which - SPACE_KINDS);
    const char *name = flight ? flight->name : space_kinds[which].name;
    double reached;
    froe_motion *m = flight ? flight_on_parabolas(flight, seed, &reached) : space_new(space_kinds + which, seed, NULL);
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k;
    froe_diagnostic why = {0};
    space_counts counts = {.blurs = flight && flight->quarters};
    o.seed = block->seed;
    if (froe_kinetic_new(m, &o, NULL, &k, &why)) {
        soak_complain(block, "%s: %s", name, why.message);
    } else {
        if (!space_follow(k, 60, &counts, &why)) soak_complain(block, "%s: %s", name, why.message);
        block->decisions += 2 * counts.compared - counts.blurred; /* node for node, and by the audit */
        froe_kinetic_free(k);
    }
    froe_motion_free(m);
}
