/* price.c: see price.h. */
#include "split/price.h"
#include "base/log2.h"

void split_price_init(split_price *price) {
    price->xlog2[0] = 0;
    for (uint32_t k = 1; k < SPLIT_PRICE_TABLE; k++) price->xlog2[k] = k * base_log2(k);
}

static double xlog2(const split_price *price, uint32_t k) {
    return k < SPLIT_PRICE_TABLE ? price->xlog2[k] : k * base_log2(k);
}

/** In bits, of the whole cell: xl(wk) = w xl(k) + wk log2 w, and m - A - B + S = on. */
static double gain(const split_price *price, split_tally t, double weight) {
    uint32_t m = split_tally_all(t);
    double bits =
        split_gain(xlog2(price, m), m, xlog2(price, t.negative + t.both), xlog2(price, t.positive + t.both), t.both);
    return weight == 1 ? bits : weight * (bits + t.on * base_log2(weight));
}

double split_price_of(const split_price *price, const split_terms *terms, split_tally t, double weight) {
    double penalty = split_penalty(split_tally_larger(t) * weight, terms->most, split_tally_all(t) * weight);
    return t.both * weight - terms->weight * gain(price, t, weight) + penalty;
}
