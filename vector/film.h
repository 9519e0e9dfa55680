/* film.h: a sequence of pictures as one list of paths, each with the time in which it is shown.
 *
 *     picture at 0      a b c d            the list       a   b   e   c   d   f
 *     picture at 1      a b e d f          from           0   0   1   0   0   1
 *                                          to             -   -   -   1   -   -
 *
 * What is shown at any time stands in the list in the order of that picture: of the paths that two pictures share, the
 * longest run that is in one order in both (Schensted 1961) stays, and all others end and begin anew. It speaks for
 * film_list.c. */
#ifndef FROE_VECTOR_FILM_H
#define FROE_VECTOR_FILM_H
#include "render.h"

typedef struct film_path {
    size_t at, length; /**< of its bytes */
    uint64_t hash;
} film_path;

/** One picture: paths, faces first, and the bytes of all. */
typedef struct film_picture {
    double time;
    bool exact; /**< it is shown at this time, whatever it shows */
    ARRAY(char) bytes;
    ARRAY(film_path) paths[2]; /**< faces, lines */
    ARRAY(uint64_t) seen;      /**< the tags of objects whose faces are in sight, ascending */
} film_picture;

typedef struct film_item {
    film_path path;
    double from, to; /**< shares of the film's time */
    uint32_t next;
} film_item;

typedef struct film_list {
    ARRAY(char) bytes;
    ARRAY(film_item) items;   /**< the first two begin the lists of faces and of lines, and are no paths */
    ARRAY(uint32_t) shown[2]; /**< of the last picture, in order */
} film_list;

/** Shows a picture from a share of the time on. False: no memory. */
bool vector_film_show(film_list *list, const film_picture *picture, double share, const froe_allocator *alloc);
/** Writes all paths, with their times in a round of so many seconds. Returns how many there are. */
uint64_t vector_film_put(const film_list *list, double seconds, vector_output *output);
void vector_film_free(film_list *list, const froe_allocator *alloc);
#endif
