/* claims_motion.c: what Agarwal, Erickson and Guibas say of partitions that follow moving segments. */
#include "claims.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct ride {
    size_t n;
    froe_kinetic_stats start, end;
    uint64_t events;
    uint32_t height; /* the greatest seen */
} ride;

static void give_up(const froe_diagnostic *diag) {
    fprintf(stderr, "claims: %s\n", diag->message);
    exit(1);
}

static ride ride_along(const char *kind, size_t n, double time) {
    enum { STOPS = 8 };
    froe_motion *motion = NULL;
    froe_kinetic *kinetic = NULL;
    const froe_kinetic_options options = froe_kinetic_defaults();
    froe_diagnostic diag = {.message = ""};
    froe_status status = froe_generate_motion(kind, n, 1, NULL, &motion, &diag);
    if (!status) status = froe_kinetic_new(motion, &options, NULL, &kinetic, &diag);
    if (status) give_up(&diag);
    ride r = {.n = froe_motion_object_count(motion), .start = froe_kinetic_statistics(kinetic)};
    for (int i = 1; i <= STOPS; i++) {
        if (froe_kinetic_advance(kinetic, time * i / STOPS, NULL, NULL, &diag)) give_up(&diag);
        r.end = froe_kinetic_statistics(kinetic);
        if (r.end.height > r.height) r.height = r.end.height;
    }
    for (int k = 0; k < FROE_EVENT_KINDS; k++) r.events += r.end.events[k];
    froe_kinetic_free(kinetic);
    froe_motion_free(motion);
    return r;
}

typedef double value_fn(const ride *r);
static double events(const ride *r) {
    return (double)r->events;
}
static double touched(const ride *r) {
    return (double)(r->end.nodes_touched - r->start.nodes_touched) / (double)r->events;
}
static double certificates_made(const ride *r) {
    return (double)(r->end.certificates_made - r->start.certificates_made) / (double)r->events;
}
static double certificates(const ride *r) {
    return (double)r->end.certificates / (double)r->end.nodes;
}

static double growth(const char *kind, size_t from, int doublings, double time, value_fn *fn) {
    claims_series s = {.count = 0};
    for (int i = 0; i <= doublings; i++) {
        const ride r = ride_along(kind, from << i, time);
        claims_add(&s, (double)r.n, fn(&r));
    }
    return claims_slope(&s);
}

static double event_count(void) {
    return growth("moving", 50, 4, 1, events);
}
static double nodes_touched(void) {
    return growth("moving", 50, 4, 1, touched);
}
static double made(void) {
    return growth("moving", 50, 4, 1, certificates_made);
}
static double live(void) {
    return growth("moving", 50, 4, 1, certificates);
}
static double height(void) {
    claims_series s = {.count = 0};
    for (size_t n = 50; n <= 800; n *= 2) {
        const ride r = ride_along("moving", n, 1);
        claims_add(&s, log((double)r.n), r.height);
    }
    return claims_slope(&s);
}

const claim claims_motion[] = {{"Agarwal et al., theorem 3.7", "O(n^2) events of segments that move straight", NULL,
                                "exponent of events in n, moving", 1, 2.2, event_count},
                               {"Agarwal et al., lemmas 3.2, 3.3, 3.5", "O(log n) expected work an event", NULL,
                                "exponent of nodes touched an event in n, moving", -INFINITY, 0.4, nodes_touched},
                               {"Agarwal et al., lemma 3.1", "O(1) new certificates an event", NULL,
                                "exponent of certificates made an event in n, moving", -INFINITY, 0.25, made},
                               {"Agarwal et al., lemma 3.1", "O(n + k) certificates, linear in the size", NULL,
                                "exponent of certificates / nodes in n, moving", -INFINITY, 0.1, live},
                               {"Agarwal et al., theorem 2.3", "height O(log n) at all times", NULL,
                                "exponent of height in log n, moving", 0.5, 1.5, height},
                               {0}};
