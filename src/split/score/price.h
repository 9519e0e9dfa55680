/* price.h: the cost of a cut: the fragments that it splits, less the information that it gains on their places.
 *
 * A cell of m fragments leaves log2 m bits open for each. A cut that leaves A and B fragments on its sides,
 * of which it splits S, and takes the rest out of the search, gains
 *     g = xl(m) - xl(A) - xl(B) + S log2 m   bits,   xl(k) = k log2 k,
 * and costs S - w g. A side of more than `most` fragments costs more than any splits. */
#ifndef FROE_SPLIT_SCORE_PRICE_H
#define FROE_SPLIT_SCORE_PRICE_H
#include <stdbool.h>
#include <stdint.h>

/** How a cut deals with the fragments of a cell. */
typedef struct split_tally {
    uint32_t negative, positive, on, both; /**< disjoint classes */
} split_tally;

enum { SPLIT_PRICE_TABLE = 4096 };

typedef struct split_price {
    double xlog2[SPLIT_PRICE_TABLE]; /**< k log2 k of small k */
} split_price;

typedef struct split_terms {
    double weight; /**< w */
    double most;   /**< fragments of the cell that may be left on a side; INFINITY: any number */
} split_terms;

void split_price_init(split_price *price);
/** Of a cut that deals so with a cell of which one fragment in `weight` is shown. Lower is better. */
double split_price_of(const split_price *price, const split_terms *terms, split_tally tally, double weight);

/** The price among boxes, balls and hulls, which are not split but listed on both sides: comparisons of pairs that are
 * left, of all, and copies at `copy` each. 1: as much as without the cut. */
double split_price_of_copies(split_tally tally, double copy);

/** g, from xl(m), m, xl(A), xl(B) and S. */
static inline double split_gain(double whole, uint32_t m, double a, double b, uint32_t splits) {
    return whole - a - b + splits * (whole / m);
}
/** What a side of `larger` of m fragments costs for being too full. */
static inline double split_penalty(double larger, double most, double m) {
    return larger > most ? 0x1p20 * (larger - most) / m : 0;
}

/** Fragments on the fuller side, split ones included. */
static inline uint32_t split_tally_larger(split_tally t) {
    return (t.negative > t.positive ? t.negative : t.positive) + t.both;
}
static inline uint32_t split_tally_all(split_tally t) {
    return t.negative + t.positive + t.on + t.both;
}
/** Does the cut separate anything? Then each side has fewer fragments than the cell. */
static inline bool split_tally_useful(split_tally t) {
    return t.on || (t.negative && t.positive);
}

/** What all prices of one cell have in common: it shows m fragments, of `weight` each. */
typedef struct split_prices {
    const split_price *table;
    split_terms terms;
    uint32_t m;
    double weight, whole, each, bits; /**< xl(m), log2 m, log2 weight */
} split_prices;

split_prices split_prices_of(const split_price *table, const split_terms *terms, uint32_t m, double weight);
/** k log2 k beyond the table. */
double split_price_far(uint32_t k);
static inline double split_xlog2(const split_price *price, uint32_t k) {
    return k < SPLIT_PRICE_TABLE ? price->xlog2[k] : split_price_far(k);
}
/** split_price_of(), for less. */
static inline double split_prices_cost(const split_prices *p, split_tally t) {
    const double negative = split_xlog2(p->table, t.negative + t.both);
    const double positive = split_xlog2(p->table, t.positive + t.both);
    double gain = p->whole - negative - positive + t.both * p->each;
    /* in bits, of the whole cell: xl(wk) = w xl(k) + wk log2 w, and m - A - B + S = on */
    if (p->weight != 1) gain = p->weight * (gain + t.on * p->bits);
    const double penalty = split_penalty(split_tally_larger(t) * p->weight, p->terms.most, p->m * p->weight);
    return t.both * p->weight - p->terms.weight * gain + penalty;
}
#endif
