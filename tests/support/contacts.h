/* contacts.h: the contacts of moving segments, held against whole numbers, pair by pair. */
#ifndef FROE_TESTS_SUPPORT_CONTACTS_H
#define FROE_TESTS_SUPPORT_CONTACTS_H
#include "support/found.h"

#include "oracle/moving.h"

/* Do the two enclosures of one instant overlap, and is ours as narrow as doubles allow? */
static inline void judge_same_instant(const froe_motion *m, const double ours[2], mpq_t theirs[2]) {
    mpq_t low, high;
    mpq_inits(low, high, NULL);
    mpq_set_d(low, ours[0]);
    mpq_set_d(high, ours[1]);
    assert_true(mpq_cmp(low, theirs[1]) <= 0 && mpq_cmp(theirs[0], high) <= 0);
    assert_true(ours[1] - ours[0] <= froe_motion_window(m).end * 0x1p-50);
    mpq_clears(low, high, NULL);
}

/* What was found about a pair, in order of time. */
static inline int judge_of_pair(const found *f, uint32_t a, uint32_t b, const froe_contact **out) {
    int count = 0;
    for (size_t i = 0; i < f->count; i++)
        if (f->list[i].a == a && f->list[i].b == b) out[count++] = &f->list[i];
    return count;
}

typedef struct judged_contacts {
    uint64_t pairs, contacts, instants, from_start, lasting;
} judged_contacts;

static inline void judge_pair(const froe_motion *m, const found *f, uint32_t a, uint32_t b, oracle_contacts *truth,
                              judged_contacts *t) {
    const froe_contact *ours[ORACLE_MOST];
    oracle_contacts_find(truth, m, a, b);
    t->pairs++;
    assert_int_equal(judge_of_pair(f, a, b, ours), truth->count);
    for (int i = 0; i < truth->count; i++) {
        oracle_contact *c = &truth->list[i];
        judge_same_instant(m, ours[i]->begin, c->begin);
        judge_same_instant(m, ours[i]->end, c->end);
        assert_int_equal(ours[i]->instant, c->instant);
        assert_int_equal(ours[i]->since_start, c->since_start);
        assert_int_equal(ours[i]->to_stop, c->to_stop);
        t->contacts++;
        t->instants += c->instant;
        t->from_start += c->since_start;
        t->lasting += !c->instant;
    }
}

/* Two objects of one body. */
static inline bool judge_is_left_out(const froe_motion *m, uint32_t a, uint32_t b) {
    const uint32_t body = froe_motion_vertex_body(m, froe_motion_object(m, a).vertices[0]);
    return body != FROE_NONE && body == froe_motion_vertex_body(m, froe_motion_object(m, b).vertices[0]);
}

/** All contacts of the motion, by one thread and by three. */
static inline void judge_contacts(const froe_motion *m, judged_contacts *t) {
    static found f, again;
    froe_contact_options o = froe_contact_defaults();
    o.threads = 1;
    found_in(m, &o, &f);
    o.threads = 3;
    found_in(m, &o, &again);
    assert_int_equal(f.count, again.count);
    assert_memory_equal(f.list, again.list, f.count * sizeof *f.list);
    oracle_contacts truth;
    oracle_contacts_init(&truth);
    for (uint32_t a = 0; a < froe_motion_object_count(m); a++)
        for (uint32_t b = a + 1; b < froe_motion_object_count(m); b++)
            if (!judge_is_left_out(m, a, b)) judge_pair(m, &f, a, b, &truth, t);
    oracle_contacts_clear(&truth);
}
#endif
