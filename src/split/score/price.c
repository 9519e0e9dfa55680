/* price.c: see price.h. */
#include "split/score/price.h"
#include "base/log2.h"
#include "support/arithmetic.h"

void split_price_init(split_price *price) {
    price->xlog2[0] = 0;
    for (uint32_t k = 1; k < SPLIT_PRICE_TABLE; k++) price->xlog2[k] = k * base_log2(k);
}

double split_price_far(uint32_t k) {
    return k * base_log2(k);
}

split_prices split_prices_of(const split_price *table, const split_terms *terms, uint32_t m, double weight) {
    const double whole = split_xlog2(table, m);
    return (split_prices){table, *terms, m, weight, whole, whole / m, weight != 1 ? base_log2(weight) : 0};
}

double split_price_of(const split_price *price, const split_terms *terms, split_tally t, double weight) {
    const split_prices prices = split_prices_of(price, terms, split_tally_all(t), weight);
    return split_prices_cost(&prices, t);
}

double split_price_of_copies(split_tally t, double copy) {
    double m = split_tally_all(t), a = t.negative + t.both, b = t.positive + t.both;
    return (a * a + b * b) / (m * m) + copy * t.both / m;
}
