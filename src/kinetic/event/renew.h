/* renew.h: segments that stay in the tree while their plans take other pieces.
 *
 *         piece | piece       The tree depends on where segments are and not on where they go, and plans are
 *            __.o._           continuous. So where all certificates that are about a segment hold just after the tick
 *         _.-   :  `-.        at which its ends take other pieces, the tree is right there. Only the ticks at which
 *               : T           these certificates fail have changed: O(k + 1) for a segment with k crossings, on
 * average (lemma 3.1 of the paper).
 *
 * Certificates prove a tree right unless points coincide for as long as pieces last. Then some have neither walls nor
 * certificates, and may part when a plan goes on. So segments that coincide with others anywhere leave and enter
 * (change.h), as do those that share a vertex, those in one line with others, and all of an augmented partition, where
 * certificates also cover turns. So does a segment with a certificate that does not hold then, or that is about a
 * crossing whose lines have turned past each other.
 *
 * The certificates about a segment are found among all. That pays where many plans go on at once, as in tracks that are
 * sampled at common times. A plan that goes on alone among very many segments leaves and enters. */
#ifndef FROE_KINETIC_RENEW_H
#define FROE_KINETIC_RENEW_H
#include <froe/kinetic.h>
#include <stdint.h>

/** Lists a segment that leaves, which is not listed yet, as in events.leaving. */
void renew_note_leaving(froe_kinetic *k, uint32_t segment, uint32_t tell_it);
/** Takes those of events.leaving that may stay, until a tick when their plans go on, out of that list. */
void renew_choose(froe_kinetic *k, int64_t tick);
/** Finds when the certificates of those fail that stay, and puts segments with one that does not hold just after the
 * tick back. REQUIRES: nothing else is to leave. */
void renew_check(froe_kinetic *k, int64_t tick);
/** At the tick: sets when these certificates fail, and lists all that leave and stay by their numbers. */
void renew_apply(froe_kinetic *k);
#endif
