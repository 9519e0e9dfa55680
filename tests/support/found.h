/* found.h: the contacts of a motion, as a list. */
#ifndef FROE_TESTS_SUPPORT_FOUND_H
#define FROE_TESTS_SUPPORT_FOUND_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <froe/kinetic.h>

enum { FOUND_MOST = 8192 };

typedef struct found {
    froe_contact list[FOUND_MOST];
    size_t count;
} found;

static inline bool found_note(void *user, const froe_contact *c) {
    found *f = user;
    assert_true(f->count < FOUND_MOST);
    f->list[f->count++] = *c;
    return true;
}

/* o may be NULL. */
static inline void found_in(const froe_motion *m, const froe_contact_options *o, found *out) {
    out->count = 0;
    assert_int_equal(froe_motion_contacts(m, o, found_note, out, NULL), FROE_OK);
}
#endif
