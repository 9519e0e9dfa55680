/* tours.h: the scenes on which a kind of question is held against brute force, one after the other. */
#ifndef FROE_TESTS_QUERY_TOURS_H
#define FROE_TESTS_QUERY_TOURS_H
#include "query/exact_world.h"

/** Asks as many questions as said of every tree of a world, and ends the world. */
typedef void tour_check(world w, int questions);

enum {
    TOUR_FLAT = 1 << FROE_POINT | 1 << FROE_SEGMENT | 1 << FROE_BOX | 1 << FROE_BALL | 1 << FROE_HULL,
    TOUR_MANY = 1 << FROE_POINT | 1 << FROE_BOX | 1 << FROE_BALL, /**< kinds of any dimension */
};

/** Does the oracle know the objects that a generator makes? Polytopes above dimension 3: test_high_objects.c. */
static inline bool tour_knows(const froe_generator_info *info) {
    return info->dim <= 3 || TOUR_MANY >> info->kind & 1;
}

/** One scene by every generator; fewer questions where coordinates make rationals long. */
static inline void tour_generators(tour_check *check, int questions, int slow_questions) {
    for (size_t g = 0; froe_generator_at(g); g++) {
        const char *name = froe_generator_at(g)->name;
        const bool slow = strstr(name, "huge") || strstr(name, "denormal");
        if (!tour_knows(froe_generator_at(g))) continue;
        check(world_begin(name, world_generate(name, 60)), (slow ? slow_questions : questions) / EXACT_SHARE);
    }
}

/** All kinds of objects at once in two, three and five dimensions, on lattices and off. */
static inline void tour_mixtures(tour_check *check, uint64_t seeds, int questions) {
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        const uint32_t grid = seed % 2 ? 0 : (uint32_t)seed;
        world w[] = {
            world_begin("plane", world_mixture(2, TOUR_FLAT, 8, grid, 0.4, seed)),
            world_begin("space", world_mixture(3, TOUR_FLAT | 1 << FROE_POLYGON, 8, grid, 0.5, seed)),
            world_begin("five dimensions", world_mixture(5, TOUR_MANY, 20, grid, 0.8, seed)),
        };
        for (size_t i = 0; i < sizeof w / sizeof *w; i++) {
            w[i].lattice = grid;
            check(w[i], questions / EXACT_SHARE);
        }
    }
}

/** A floor plan, a map, a mesh and boxes. */
static inline void tour_files(tour_check *check, int questions) {
    static const char *const files[] = {"freedoom-e1m1.geojson", "countries-110m.json", "utah-teapot.obj",
                                        "fzk-haus-boxes.csv"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        check(world_begin(files[i], world_read(files[i])), questions / EXACT_SHARE);
}

/** No object, and one of every kind. */
static inline void tour_tiny(tour_check *check) {
    for (int dim = 2; dim <= 4; dim++) check(world_begin("none", world_mixture(dim, 0, 0, 0, 1, 1)), 20);
    for (int kind = 0; kind < FROE_KIND_COUNT; kind++)
        for (int dim = kind == FROE_POLYGON ? 3 : 2; dim <= 3; dim++)
            check(world_begin("one", world_mixture(dim, 1u << kind, 1, 3, 1, 1)), 40);
}

/** Scenes of every scale at once, of every dimension, and questions at every scale. */
static inline void tour_extremes(tour_check *check, uint64_t scenes, int questions) {
    const uint64_t first = extreme_seed(), last = first + scenes * extreme_rounds() / EXACT_SHARE;
    for (uint64_t seed = first; seed < last; seed++) {
        static const unsigned plane[] = {1 << FROE_SEGMENT, TOUR_FLAT, 1 << FROE_POINT | 1 << FROE_SEGMENT};
        static const unsigned space[] = {1 << FROE_POLYGON, TOUR_FLAT | 1 << FROE_POLYGON};
        const int dim = seed % 9 == 8 ? 4 + (int)(seed / 9 % (FROE_MAX_DIM - 3)) : 2 + (int)(seed % 2);
        const unsigned kinds = dim == 2 ? plane[seed / 2 % 3] : dim == 3 ? space[seed / 2 % 2] : TOUR_MANY;
        char name[64];
        snprintf(name, sizeof name, "extremes, FROE_SEED=%llu", (unsigned long long)seed);
        world w = world_begin(name, extreme_scene_new(dim, kinds, dim == 2 ? 9 : 6, seed));
        w.extreme = true;
        check(w, questions);
    }
}
#endif
