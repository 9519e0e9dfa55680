/* places.c: where the ends of a snapshot's objects are, as quotients of whole numbers. */
#include "kinetic/places.h"
#include <string.h>

/* The limbs of a number from place `low` on. */
static bool append_limbs(froe_places *p, num_dyadic a, int low, places_part *out) {
    const size_t zeros = a.sign ? (size_t)(a.exponent - low) : 0;
    *out = (places_part){p->limbs.count, (uint32_t)(zeros + a.count), a.sign};
    if (!a.sign) return true; /* no limbs, and perhaps no array */
    if (!array_reserve(&p->alloc, &p->limbs, out->count)) return false;
    uint64_t *to = p->limbs.data + p->limbs.count;
    memset(to, 0, zeros * sizeof *to);
    memcpy(to + zeros, a.limbs, a.count * sizeof *to);
    p->limbs.count += out->count;
    return true;
}

/* Takes out the powers of two that all three numbers have in common. */
static void reduce(froe_places *p, places_part part[3]) {
    uint64_t low = 0;
    for (int i = 0; i < 3; i++) low |= part[i].count ? p->limbs.data[part[i].at] : 0;
    const int shift = low ? __builtin_ctzll(low) : 0;
    for (int i = 0; i < 3; i++) {
        uint64_t *limb = p->limbs.data + part[i].at;
        for (uint32_t k = 0; k < part[i].count && shift; k++) {
            const uint64_t next = k + 1 < part[i].count ? limb[k + 1] : 0;
            limb[k] = limb[k] >> shift | next << (64 - shift);
        }
        while (part[i].count && !limb[part[i].count - 1]) part[i].count--;
    }
}

bool places_add(froe_places *p, const exact_point *at, bool rounded) {
    const num_dyadic number[3] = {at->x.c[0], at->y.c[0], at->w.c[0]};
    places_entry entry = {.rounded = rounded};
    int low = number[2].exponent; /* w > 0 */
    for (int i = 0; i < 2; i++)
        if (number[i].sign && number[i].exponent < low) low = number[i].exponent;
    for (int i = 0; i < 3; i++)
        if (!append_limbs(p, number[i], low, entry.part + i)) return false;
    reduce(p, entry.part);
    return array_push(&p->alloc, &p->entries, entry);
}

froe_places *places_new(const froe_allocator *alloc) {
    froe_places *p = support_calloc(alloc, 1, sizeof *p);
    if (p) p->alloc = *alloc;
    return p;
}

void froe_places_free(froe_places *p) {
    if (!p) return;
    const froe_allocator alloc = p->alloc;
    array_free(&alloc, &p->limbs);
    array_free(&alloc, &p->entries);
    support_free(&alloc, p, sizeof *p);
}

size_t froe_places_count(const froe_places *p) {
    return p ? p->entries.count / 2 : 0;
}

bool froe_places_end(const froe_places *p, uint32_t object, int end, froe_exact_place *out) {
    if (!out || end < 0 || end > 1 || object >= froe_places_count(p)) return false;
    const places_entry *entry = p->entries.data + 2 * (size_t)object + (size_t)end;
    froe_whole *number[3] = {&out->x, &out->y, &out->w};
    for (int i = 0; i < 3; i++) {
        const places_part *part = entry->part + i;
        *number[i] = (froe_whole){part->sign, part->count, p->limbs.data + part->at};
    }
    out->rounded = entry->rounded;
    return true;
}

/* ------------------------------------------------------------------ decimals -- */

enum { PLACES_DIGITS = 18, PLACES_LIMBS = 256 }; /* a coordinate and two times squared, on one scale: less than 170 */

/* Divides by 10^PLACES_DIGITS and returns the rest. */
static uint64_t take_digits(uint64_t *limbs, size_t *count) {
    const uint64_t unit = 1000000000000000000u;
    num_limbs2 rest = 0;
    for (size_t i = *count; i-- > 0;) {
        rest = rest << 64 | limbs[i];
        limbs[i] = (uint64_t)(rest / unit);
        rest %= unit;
    }
    while (*count && !limbs[*count - 1]) --*count;
    return (uint64_t)rest;
}

size_t froe_whole_text(const froe_whole *number, char *out, size_t size) {
    uint64_t limbs[PLACES_LIMBS];
    size_t count = number && number->count <= PLACES_LIMBS ? number->count : 0, length = 0;
    char digits[PLACES_LIMBS * 20 + 2]; /* the least significant first */
    for (size_t i = 0; i < count; i++) limbs[i] = number->limbs[i];
    while (count) {
        uint64_t part = take_digits(limbs, &count);
        for (int i = 0; i < PLACES_DIGITS && (count || part); i++, part /= 10)
            digits[length++] = (char)('0' + part % 10);
    }
    if (!length) digits[length++] = '0';
    if (number && number->sign < 0) digits[length++] = '-';
    for (size_t i = 0; i < length && i + 1 < size; i++) out[i] = digits[length - 1 - i];
    if (size) out[length < size ? length : size - 1] = 0;
    return length;
}
