/* price.c: see price.h. */
#include "split/price.h"
#include "base/log2.h"
#include "support/arithmetic.h"

void split_price_init(split_price *price) {
    price->xlog2[0] = 0;
    for (uint32_t k = 1; k < SPLIT_PRICE_TABLE; k++) price->xlog2[k] = k * base_log2(k);
}

static double xlog2(const split_price *price, uint32_t k) {
    return k < SPLIT_PRICE_TABLE ? price->xlog2[k] : k * base_log2(k);
}

double split_price_of(const split_price *price, const split_terms *terms, split_tally t, double weight) {
    uint32_t m = split_tally_all(t), negative = t.negative + t.both, positive = t.positive + t.both;
    double gain = split_gain(xlog2(price, m), m, xlog2(price, negative), xlog2(price, positive), t.both);
    /* in bits, of the whole cell: xl(wk) = w xl(k) + wk log2 w, and m - A - B + S = on */
    if (weight != 1) gain = weight * (gain + t.on * base_log2(weight));
    double penalty = split_penalty(split_tally_larger(t) * weight, terms->most, m * weight);
    return t.both * weight - terms->weight * gain + penalty;
}

double split_price_of_copies(split_tally t, double copy) {
    double m = split_tally_all(t), a = t.negative + t.both, b = t.positive + t.both;
    return (a * a + b * b) / (m * m) + copy * t.both / m;
}
