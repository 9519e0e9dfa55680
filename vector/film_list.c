/* film_list.c: see film.h. */
#include "film.h"
#include <stdlib.h>
#include <string.h>

enum { END = UINT32_MAX };

typedef struct known_path {
    uint64_t hash;
    uint32_t place; /* among those that are shown */
} known_path;

/* The work of one picture. */
typedef struct film_match {
    ARRAY(known_path) known;
    ARRAY(uint32_t) place; /* of each new path: that of the same one which is shown, or END */
    ARRAY(uint32_t) tails, before, taken;
} film_match;

static int compare_known(const void *a, const void *b) {
    const known_path *p = a, *q = b;
    if (p->hash != q->hash) return p->hash < q->hash ? -1 : 1;
    return (p->place > q->place) - (p->place < q->place);
}

/* Finds each new path among those that are shown; of equal ones each once. */
static bool match_paths(const film_list *list, const film_picture *picture, int kind, film_match *m,
                        const froe_allocator *alloc) {
    const size_t shown = list->shown[kind].count, count = picture->paths[kind].count;
    m->known.count = m->place.count = m->taken.count = 0;
    if (!array_reserve(alloc, &m->known, shown) || !array_reserve(alloc, &m->place, count) ||
        !array_reserve(alloc, &m->taken, shown))
        return false;
    for (uint32_t i = 0; i < shown; i++) {
        m->known.data[i] = (known_path){list->items.data[list->shown[kind].data[i]].path.hash, i};
        m->taken.data[i] = 0;
    }
    if (shown) qsort(m->known.data, shown, sizeof *m->known.data, compare_known);
    for (size_t i = 0; i < count; i++) {
        const film_path *path = picture->paths[kind].data + i;
        size_t low = 0, high = shown;
        while (low < high) {
            const size_t middle = low + (high - low) / 2;
            if (m->known.data[middle].hash < path->hash)
                low = middle + 1;
            else
                high = middle;
        }
        m->place.data[i] = END;
        for (; low < shown && m->known.data[low].hash == path->hash && m->place.data[i] == END; low++) {
            const uint32_t place = m->known.data[low].place;
            const film_path *other = &list->items.data[list->shown[kind].data[place]].path;
            if (m->taken.data[place] || other->length != path->length ||
                memcmp(list->bytes.data + other->at, picture->bytes.data + path->at, path->length) != 0)
                continue;
            m->place.data[i] = place, m->taken.data[place] = 1;
        }
    }
    return true;
}

/* Keeps the places of a longest ascending run, and makes all others END. */
static bool keep_ascending(film_match *m, size_t count, const froe_allocator *alloc) {
    m->tails.count = m->before.count = 0;
    if (!array_reserve(alloc, &m->tails, count) || !array_reserve(alloc, &m->before, count)) return false;
    uint32_t *tails = m->tails.data, *place = m->place.data; /* tails[k]: where the run of k + 1 that ends least ends */
    size_t longest = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (place[i] == END) continue;
        size_t low = 0, high = longest;
        while (low < high) {
            const size_t middle = low + (high - low) / 2;
            if (place[tails[middle]] < place[i])
                low = middle + 1;
            else
                high = middle;
        }
        m->before.data[i] = low ? tails[low - 1] : END;
        tails[low] = i;
        longest += low == longest;
    }
    uint32_t kept = longest ? tails[longest - 1] : END;
    for (size_t i = count; i-- > 0;) {
        if (i == kept)
            kept = m->before.data[i];
        else
            place[i] = END;
    }
    return true;
}

static bool put_new(film_list *list, const film_picture *picture, const film_path *path, double share, uint32_t after,
                    const froe_allocator *alloc) {
    film_item item = {.path = *path, .from = share, .to = 1, .next = list->items.data[after].next};
    item.path.at = list->bytes.count;
    if (list->items.count >= END || !array_append(alloc, &list->bytes, picture->bytes.data + path->at, path->length) ||
        !array_push(alloc, &list->items, item))
        return false;
    list->items.data[after].next = (uint32_t)(list->items.count - 1);
    return true;
}

static bool show_kind(film_list *list, const film_picture *picture, int kind, double share, film_match *m,
                      const froe_allocator *alloc) {
    const size_t count = picture->paths[kind].count;
    if (!match_paths(list, picture, kind, m, alloc) || !keep_ascending(m, count, alloc)) return false;
    uint32_t *shown = list->shown[kind].data, after = (uint32_t)kind;
    for (size_t i = 0; i < list->shown[kind].count; i++) list->items.data[shown[i]].to = share;
    m->taken.count = 0; /* from here on those that are shown now */
    for (size_t i = 0; i < count; i++) {
        const uint32_t place = m->place.data[i];
        if (place != END)
            after = shown[place], list->items.data[after].to = 1;
        else if (!put_new(list, picture, picture->paths[kind].data + i, share, after, alloc))
            return false;
        else
            after = (uint32_t)(list->items.count - 1);
        if (!array_push(alloc, &m->taken, after)) return false;
    }
    list->shown[kind].count = 0;
    return array_append(alloc, &list->shown[kind], m->taken.data, m->taken.count);
}

bool vector_film_show(film_list *list, const film_picture *picture, double share, const froe_allocator *alloc) {
    film_match m = {.known = {0}};
    bool room = true;
    while (list->items.count < 2 && room) room = array_push(alloc, &list->items, (film_item){.next = END});
    for (int kind = 0; kind < 2 && room; kind++) room = show_kind(list, picture, kind, share, &m, alloc);
    array_free(alloc, &m.known), array_free(alloc, &m.place), array_free(alloc, &m.tails);
    array_free(alloc, &m.before), array_free(alloc, &m.taken);
    return room;
}

void vector_film_free(film_list *list, const froe_allocator *alloc) {
    array_free(alloc, &list->bytes), array_free(alloc, &list->items);
    for (int kind = 0; kind < 2; kind++) array_free(alloc, &list->shown[kind]);
}

/* ---------------------------------------------------------------------- writing -- */

/* A group of paths that are shown from one time to another; those of the first picture also where nothing moves. */
static void put_span(double from, double to, double seconds, vector_output *output) {
    const vector_digits first = vector_exact(from), last = vector_exact(to);
    vector_print(output,
                 "<g class=%s>\n<animate attributeName=\"display\" calcMode=\"discrete\" dur=\"%ss\" "
                 "repeatCount=\"indefinite\" ",
                 from > 0 ? "\"other\" display=\"none\"" : "\"first\"", vector_real(6, seconds).text);
    if (!(from > 0))
        vector_print(output, "values=\"inline;none\" keyTimes=\"0;%s\"/>\n", last.text);
    else if (to < 1)
        vector_print(output, "values=\"none;inline;none\" keyTimes=\"0;%s;%s\"/>\n", first.text, last.text);
    else
        vector_print(output, "values=\"none;inline\" keyTimes=\"0;%s\"/>\n", first.text);
}

static uint64_t put_list(const film_list *list, uint32_t head, double seconds, vector_output *output) {
    double from = 0, to = 1; /* of the group that is open; all the time: none is */
    uint64_t count = 0;
    for (uint32_t i = list->items.data[head].next; i != END; i = list->items.data[i].next) {
        const film_item *item = list->items.data + i;
        if (item->from != from || item->to != to) {
            if (from > 0 || to < 1) vector_put(output, "</g>\n", 5);
            from = item->from, to = item->to;
            if (from > 0 || to < 1) put_span(from, to, seconds, output);
        }
        vector_put(output, list->bytes.data + item->path.at, item->path.length);
        count++;
    }
    if (from > 0 || to < 1) vector_put(output, "</g>\n", 5);
    return count;
}

uint64_t vector_film_put(const film_list *list, double seconds, vector_output *output) {
    static const char style[] = VECTOR_SVG_STILL, lines[] = VECTOR_SVG_LINES;
    if (!list->items.count) return 0;
    vector_put(output, style, sizeof style - 1);
    const uint64_t faces = put_list(list, 0, seconds, output);
    vector_put(output, lines, sizeof lines - 1);
    const uint64_t all = faces + put_list(list, 1, seconds, output);
    vector_put(output, "</g>\n", 5);
    return all;
}
