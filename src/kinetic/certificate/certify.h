/* certify.h: which certificates prove that a partition in motion is what it should be.
 *
 *        :  |  :                      regions   the walls left and right of a region keep their order. Only regions
 *     ___:__|__:___ above             without a wall inside have certificates: these imply the others
 *        :  o----             ends    an end with a wall is below the next segment above and above the next below
 *     ___:_____:___ below     turns   the left end of a segment is left of the right end
 *                             flops   in space: a triangle shows the same side upwards
 *
 * As long as they all hold the partition is right, and when one fails it is repaired near that place. Source: the
 * paper's section 3.1, where such regions are the cells of transient nodes. That regions between a wall of the node and
 * one of its cell need certificates, too, is not in the paper. */
#ifndef FROE_KINETIC_CERTIFY_H
#define FROE_KINETIC_CERTIFY_H
#include "kinetic/certificate/cert.h"
#include "kinetic/tree/ktree.h"

/** After surgery at the site: certificates of all that was touched, and above. */
void certify_site(froe_kinetic *k, const ktree_site *site);
/** The same of several subtrees, none of which is in another. */
void certify_sites(froe_kinetic *k, const ktree_site *const sites[], int count);
/** Looks up which end is on the left, and makes the certificate of that. */
void certify_turn(froe_kinetic *k, uint32_t segment);
/** Makes the certificate that a triangle keeps the sign of its area, as seen from above, if it has any. */
void certify_flop(froe_kinetic *k, uint32_t surface);
/** The kind of a certificate; of a region, which one it is now. */
cert_kind certify_kind(const ktree *tree, const cert_table *certs, uint32_t cert);
/** What a certificate says now. */
now_claim certify_claim_of(const froe_kinetic *k, uint32_t cert);
/** For a certificate that was due, but holds: finds when it fails next. */
void certify_again(froe_kinetic *k, uint32_t cert);
/** When a claim fails. */
int64_t certify_fail_tick(froe_kinetic *k, const now_claim *claim);
/** What a passing has changed on one side of the wall. */
typedef struct certify_side {
    const ktree_site *site;
    int side;              /**< of its cell, on which the wall has become */
    name_point wall;       /**< this one */
    const uint32_t *nodes; /**< those with walls next to it, children before parents */
    size_t count;
    int own; /**< on which side the node at the site has got a wall, or lost one; -1: it has not */
} certify_side;
/** Does what certify_sites() does after a passing, of which all is known that changed. `common`: the lowest node above
 * both sites. REQUIRES: the tree is in the plane and not augmented. */
void certify_passing(froe_kinetic *k, const certify_side both[2], uint32_t common);
/** The names of the walls of a region: CERT_LEFT, CERT_MIDDLE, CERT_RIGHT. cell NULL: they are found. */
void certify_borders(const ktree *tree, uint32_t node, const ktree_cell *cell, cert_kind region, name_point out[2]);
#endif
