/* manifest.c: see manifest.h. Reading makes a plan of what the numbers say, prints the text of that plan, and compares:
 * so whatever is read is what would be written. */
#include "manifest.h"
#include "sample.h"
#include "shard.h"
#include "support/decimal/decimal.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/locale.h"
#include "support/writer.h"
#include <math.h>
#include <stdio.h>

static const char first_line[] = "froe shards 1\n";

/* ----------------------------------------------------------------- checksum -- */

uint64_t shards_manifest_sum(const char *text, size_t count) {
    uint64_t sum = shards_mix(0, count);
    for (size_t at = 0; at < count; at += 8) {
        uint64_t word = 0;
        for (size_t i = 0; i < 8 && at + i < count; i++) word |= (uint64_t)(unsigned char)text[at + i] << 8 * i;
        sum = shards_mix(sum, word);
    }
    return sum;
}

/* ----------------------------------------------------------------- printing -- */

static bool add_text(shards_text *t, const froe_allocator *alloc, const char *text) {
    return array_append(alloc, t, text, strlen(text));
}

static bool add_whole(shards_text *t, const froe_allocator *alloc, uint64_t value) {
    char digits[24] = " ";
    return array_append(alloc, t, digits, 1 + support_decimal_whole(digits + 1, value));
}

/* 17 digits give back every double, and infinite bounds do not occur. */
static bool add_real(shards_text *t, const froe_allocator *alloc, double value) {
    char digits[SUPPORT_DECIMAL_ROOM];
    const size_t length = support_decimal_format(digits, value, 17);
    return add_text(t, alloc, " ") && array_append(alloc, t, digits, length);
}

static bool add_check(shards_text *t, const froe_allocator *alloc, uint64_t check) {
    char digits[20];
    snprintf(digits, sizeof digits, " %016llx", (unsigned long long)check);
    return add_text(t, alloc, digits);
}

static bool add_shard_line(shards_text *t, const froe_allocator *alloc, int dim, const froe_shard_entry *e) {
    bool ok = add_text(t, alloc, "shard") && add_whole(t, alloc, e->objects);
    if (e->objects)
        ok = ok && add_whole(t, alloc, e->own) && add_whole(t, alloc, e->bytes) && add_check(t, alloc, e->check);
    for (int i = 0; i < 2 * dim && e->objects && ok; i++) ok = add_real(t, alloc, i < dim ? e->lo[i] : e->hi[i - dim]);
    return ok && add_text(t, alloc, "\n");
}

bool shards_manifest_print(const froe_shard_plan *plan, const froe_shard_entry *entries, const froe_allocator *alloc,
                           shards_text *t) {
    const size_t first = t->count;
    bool ok = add_text(t, alloc, first_line) && add_text(t, alloc, "dimension") &&
              add_whole(t, alloc, (uint64_t)plan->dim) && add_text(t, alloc, "\n") &&
              (!plan->areas || add_text(t, alloc, "areas\n"));
    for (size_t i = 0; i < plan->nodes.count && ok; i++) {
        const shards_node *node = &plan->nodes.data[i];
        ok = node->axis < 0 ? add_shard_line(t, alloc, plan->dim, entries + node->upper)
                            : add_text(t, alloc, "cut") && add_whole(t, alloc, (uint64_t)node->axis) &&
                                  add_real(t, alloc, node->value) && add_text(t, alloc, "\n");
    }
    if (!ok) return false;
    const uint64_t sum = shards_manifest_sum(t->data + first, t->count - first);
    return add_text(t, alloc, "end") && add_check(t, alloc, sum) && add_text(t, alloc, "\n");
}

froe_status froe_shard_manifest_write(const froe_shard_plan *plan, const froe_shard_entry *entries, const char *folder,
                                      const froe_allocator *given, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!plan || !entries || !folder) return support_fail_null(diag, __func__);
    const froe_allocator alloc = support_allocator(given);
    const size_t size = strlen(folder) + sizeof "/" SHARDS_MANIFEST;
    char *path = support_realloc(&alloc, NULL, 0, size);
    shards_text text = {0};
    froe_status status =
        path && shards_manifest_print(plan, entries, &alloc, &text) ? FROE_OK : support_fail_memory(diag);
    if (!status) {
        snprintf(path, size, "%s/" SHARDS_MANIFEST, folder);
        status = support_write(path, text.data, text.count, &alloc, diag);
    }
    array_free(&alloc, &text);
    if (path) support_free(&alloc, path, size);
    return status;
}

/* ------------------------------------------------------------------ reading -- */

/* The rest of a text. What a function cannot read it leaves alone. */
typedef struct cursor {
    const char *at, *end;
} cursor;

static bool take_word(cursor *c, const char *word) {
    const size_t length = strlen(word);
    if ((size_t)(c->end - c->at) < length || memcmp(c->at, word, length) != 0) return false;
    c->at += length;
    return true;
}

/* A space and a number of the base, 10 or 16. Those that do not fit come out wrong, and are found by comparison. */
static bool take_whole(cursor *c, unsigned base, uint64_t *out) {
    if (!take_word(c, " ")) return false;
    const char *first = c->at;
    for (*out = 0; c->at < c->end; c->at++) {
        const unsigned digit = *c->at >= '0' && *c->at <= '9'   ? (unsigned)(*c->at - '0')
                               : *c->at >= 'a' && *c->at <= 'f' ? (unsigned)(*c->at - 'a') + 10
                                                                : 16;
        if (digit >= base) break;
        *out = *out * base + digit;
    }
    return c->at > first;
}

static bool take_real(cursor *c, double *out) {
    char text[SUPPORT_DECIMAL_ROOM + SUPPORT_DECIMAL_AHEAD] = "", *end;
    if (!take_word(c, " ")) return false;
    const size_t left = (size_t)(c->end - c->at), most = left < 30 ? left : 30;
    size_t length = 0;
    while (length < most && c->at[length] != ' ' && c->at[length] != '\n') length++;
    memcpy(text, c->at, length);
    *out = support_decimal_ahead(text, &end);
    if (!length || end != text + length || !isfinite(*out)) return false;
    c->at += length;
    return true;
}

static bool take_shard(cursor *c, int dim, froe_shard_entry *e) {
    *e = (froe_shard_entry){0};
    if (!take_whole(c, 10, &e->objects)) return false;
    if (!e->objects) return take_word(c, "\n");
    bool ok = take_whole(c, 10, &e->own) && take_whole(c, 10, &e->bytes) && take_whole(c, 16, &e->check);
    for (int i = 0; i < 2 * dim && ok; i++) ok = take_real(c, i < dim ? &e->lo[i] : &e->hi[i - dim]);
    for (int a = 0; a < dim && ok; a++) ok = e->lo[a] <= e->hi[a];
    return ok && e->own <= e->objects && take_word(c, "\n");
}

/* The lines of cuts and shards. FROE_E_FORMAT: there are none, or more than there can be, or one is no such line. */
static froe_status take_nodes(cursor *c, shards_manifest *m) {
    while (true) {
        shards_node node = {.axis = -1};
        froe_shard_entry entry;
        uint64_t axis;
        if (take_word(c, "cut")) {
            if (!take_whole(c, 10, &axis) || axis >= (uint64_t)m->plan->dim || !take_real(c, &node.value) ||
                !take_word(c, "\n"))
                return FROE_E_FORMAT;
            node.axis = (int)axis;
        } else if (take_word(c, "shard")) {
            if (m->entries.count == FROE_SHARDS_MOST || !take_shard(c, m->plan->dim, &entry)) return FROE_E_FORMAT;
            if (!array_push(&m->alloc, &m->entries, entry)) return FROE_E_MEMORY;
        } else {
            return m->entries.count ? FROE_OK : FROE_E_FORMAT;
        }
        if (m->plan->nodes.count == 2 * (size_t)FROE_SHARDS_MOST) return FROE_E_FORMAT;
        if (!array_push(&m->alloc, &m->plan->nodes, node)) return FROE_E_MEMORY;
    }
}

/* What the text says, if it is the text that would be printed of it. */
static froe_status take_manifest(const char *text, size_t count, shards_manifest *m) {
    cursor c = {text + strlen(first_line), text + count};
    uint64_t dim;
    if (!take_word(&c, "dimension") || !take_whole(&c, 10, &dim) || !take_word(&c, "\n") || dim < 2 ||
        dim > FROE_MAX_DIM)
        return FROE_E_FORMAT;
    m->plan = shards_plan_make((int)dim, &m->alloc);
    if (m->plan) m->plan->areas = take_word(&c, "areas\n");
    froe_status status = m->plan ? take_nodes(&c, m) : FROE_E_MEMORY;
    if (!status) status = shards_plan_join(m->plan);
    uint64_t objects = 0;
    for (size_t i = 0; i < m->entries.count; i++) objects |= m->entries.data[i].objects;
    if (!status && !objects) status = FROE_E_FORMAT;
    shards_text again = {0};
    if (!status && !shards_manifest_print(m->plan, m->entries.data, &m->alloc, &again)) status = FROE_E_MEMORY;
    if (!status && (again.count != count || memcmp(again.data, text, count) != 0)) status = FROE_E_FORMAT;
    array_free(&m->alloc, &again);
    return status;
}

froe_status shards_manifest_parse(const char *text, size_t count, const char *path, const froe_allocator *alloc,
                                  shards_manifest *out, froe_diagnostic *diag) {
    static const char any_version[] = "froe shards ";
    shards_manifest m = {.sum = shards_manifest_sum(text, count), .alloc = *alloc};
    support_locale locale;
    const char *name = support_short(path);
    if (count < strlen(any_version) || memcmp(text, any_version, strlen(any_version)) != 0)
        return support_fail(diag, FROE_E_FORMAT, "%s: It is no manifest of a folder of shards.", name);
    if (count < strlen(first_line) || memcmp(text, first_line, strlen(first_line)) != 0)
        return support_fail(diag, FROE_E_FORMAT,
                            "%s: The manifest is of another version, so the folder has to be built again.", name);
    if (!support_locale_enter(&locale)) return support_fail_memory(diag);
    const froe_status status = take_manifest(text, count, &m);
    support_locale_leave(&locale);
    if (!status) {
        *out = m;
        return FROE_OK;
    }
    shards_manifest_free(&m);
    if (status == FROE_E_MEMORY) return support_fail_memory(diag);
    return support_fail(diag, FROE_E_FORMAT, "%s: The manifest is damaged or cut off.", name);
}

void shards_manifest_free(shards_manifest *m) {
    froe_shard_plan_free(m->plan);
    array_free(&m->alloc, &m->entries);
    m->plan = NULL;
}
