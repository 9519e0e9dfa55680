/* select.c: quickselect with three parts, so that equal numbers cost nothing. */
#include "base/select.h"
#include "base/random.h"

double base_select(double *v, size_t count, size_t k) {
    size_t first = 0, end = count;
    while (end - first > 1) {
        const double pivot = v[first + base_mix(first ^ (uint64_t)end << 20) % (end - first)];
        size_t less = first, more = end, i = first; /* [first, less) < pivot, [less, i) equal, [more, end) > pivot */
        while (i < more) {
            const double x = v[i];
            if (x < pivot)
                v[i++] = v[less], v[less++] = x;
            else if (x > pivot)
                v[i] = v[--more], v[more] = x;
            else
                i++;
        }
        if (k >= less && k < more) return pivot;
        *(k < less ? &end : &first) = k < less ? less : more;
    }
    return v[first];
}
