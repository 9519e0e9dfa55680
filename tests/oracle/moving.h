/* moving.h: contacts of moving segments by other means than froe's: whole numbers (GMP), absolute time, all critical
 * polynomials multiplied into one whose roots are isolated by Sturm's theorem. */
#ifndef FROE_TESTS_ORACLE_MOVING_H
#define FROE_TESTS_ORACLE_MOVING_H
#include <froe/kinetic.h>
#include <gmp.h>

/** From begin to end; each instant is known to lie between two rationals. */
typedef struct oracle_contact {
    mpq_t begin[2], end[2];
    bool instant, since_start, to_stop;
} oracle_contact;

enum { ORACLE_MOST = 64 };

typedef struct oracle_contacts {
    oracle_contact list[ORACLE_MOST];
    int count;
} oracle_contacts;
void oracle_contacts_init(oracle_contacts *c);
void oracle_contacts_clear(oracle_contacts *c);

/** All contacts of two objects in the window. */
void oracle_contacts_find(oracle_contacts *out, const froe_motion *m, uint32_t a, uint32_t b);
#endif
