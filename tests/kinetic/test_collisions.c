/* test_collisions.c: questions that others ask of continuous collision detection, whose answers are known: does a
 * corner meet a triangle, do two edges meet, while all move straight from one place to another (data/collisions.csv,
 * from Wang, Ferguson, Schneider, Jiang, Attene and Panozzo: A Large-scale Benchmark and an Inclusion-based Algorithm
 * for Continuous Collision Detection, 2021; many are nearly or wholly degenerate). A corner and an edge are triangles
 * without area. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <froe/kinetic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 4, CORNERS = 6 };

typedef struct question {
    bool edges, meet;
    double at[2][POINTS][3]; /* before and after */
} question;

static bool count_contact(void *user, const froe_contact *contact) {
    assert_true(contact->begin[0] >= 0 && contact->end[1] <= 1);
    ++*(int *)user;
    return true;
}

/* The contacts of the two, with time forwards or backwards. */
static int ask(const question *q, bool backwards) {
    static const size_t starts[CORNERS + 1] = {0, 2, 4, 6, 8, 10, 12};
    static const double times[2 * CORNERS] = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1};
    static const int points[2][CORNERS] = {{0, 0, 0, 1, 2, 3}, {0, 1, 1, 2, 3, 3}};
    double at[6 * CORNERS];
    for (size_t c = 0; c < CORNERS; c++)
        for (size_t i = 0; i < 2; i++) memcpy(at + 6 * c + 3 * i, q->at[i ^ backwards][points[q->edges][c]], 24);
    froe_motion_options o = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_motion *m = NULL;
    int count = 0;
    o.dim = 3, o.begin = 0, o.end = 1;
    b.vertex_count = CORNERS, b.count = 2, b.starts = starts, b.times = times, b.coords = at;
    assert_int_equal(froe_motion_new(&o, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    assert_int_equal(froe_motion_contacts(m, NULL, count_contact, &count, NULL), FROE_OK);
    froe_motion_free(m);
    return count;
}

static bool read_question(FILE *file, question *q) {
    char line[2048], *at = line;
    if (!fgets(line, sizeof line, file)) return false;
    at = strchr(at, ',') + 1;
    q->edges = *at == 'e';
    at = strchr(at, ',') + 1;
    q->meet = *at++ == '1';
    for (int i = 0; i < 2; i++)
        for (int p = 0; p < POINTS; p++)
            for (int k = 0; k < 3; k++) {
                assert_int_equal(*at++, ',');
                q->at[i][p][k] = strtod(at, &at);
            }
    return true;
}

static void known_collisions_are_found_and_no_others(void **state) {
    (void)state;
    char heading[1024];
    question q;
    int asked[2] = {0, 0}, meet = 0;
    FILE *file = fopen(FROE_TEST_DATA "/collisions.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(heading, sizeof heading, file));
    for (; read_question(file, &q); asked[q.edges]++, meet += q.meet) {
        const int forwards = ask(&q, false);
        assert_int_equal(forwards > 0, q.meet);
        assert_int_equal(forwards, ask(&q, true));
    }
    fclose(file);
    assert_true(asked[0] > 250 && asked[1] > 150 && meet > 250);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_collisions_are_found_and_no_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
