/* paint.c: see paint.h. */
#include "formats/input/paint.h"
#include <string.h>

/* The entry of a colour, or the free one where it belongs. */
static formats_paint_entry *find_entry(formats_paint *paint, uint32_t colour) {
    const size_t mask = paint->table.count - 1;
    size_t at = (colour * UINT64_C(0x9E3779B97F4A7C15) >> 32) & mask;
    while (paint->table.data[at].colour && paint->table.data[at].colour != colour) at = (at + 1) & mask;
    return paint->table.data + at;
}

/* At most half of the table is used. */
static bool grow(formats_sink *sink, formats_paint *paint) {
    formats_paint larger = {.used = paint->used, .name = paint->name, .material = paint->material};
    const size_t size = paint->table.count ? 2 * paint->table.count : 64;
    if (!array_reserve(&sink->alloc, &larger.table, size)) return false;
    larger.table.count = size;
    memset(larger.table.data, 0, size * sizeof *larger.table.data);
    for (size_t i = 0; i < paint->table.count; i++)
        if (paint->table.data[i].colour) *find_entry(&larger, paint->table.data[i].colour) = paint->table.data[i];
    array_free(&sink->alloc, &paint->table);
    *paint = larger;
    return true;
}

froe_status formats_paint_enter(formats_sink *sink, formats_paint *paint, uint32_t colour) {
    if (!colour) return sink->group = FROE_NONE, FROE_OK;
    if (2 * (paint->used + 1) > paint->table.count && !grow(sink, paint)) return support_fail_memory(sink->diag);
    formats_paint_entry *entry = find_entry(paint, colour);
    if (!entry->colour) {
        const froe_group group = {.name = paint->name, .material = paint->material, .colour = colour};
        const froe_status status = formats_sink_group(sink, &group);
        if (status) return status;
        *entry = (formats_paint_entry){colour, sink->group};
        paint->used++;
    }
    sink->group = entry->group;
    return FROE_OK;
}

void formats_paint_free(formats_sink *sink, formats_paint *paint) {
    array_free(&sink->alloc, &paint->table);
}

uint32_t formats_paint_mean(const uint32_t *colours, size_t count) {
    uint64_t sums[4] = {0};
    uint32_t mean = 0;
    for (size_t i = 0; i < count; i++) {
        if (!colours[i]) return 0;
        for (int k = 0; k < 4; k++) sums[k] += colours[i] >> (24 - 8 * k) & 255;
    }
    for (int k = 0; count && k < 4; k++) mean = mean << 8 | (uint32_t)((sums[k] + count / 2) / count);
    return mean;
}
