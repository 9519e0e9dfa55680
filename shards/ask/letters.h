/* letters.h: the words that processes send each other about questions and what was found; see share.h.
 *
 *     of questions     1: the sender has questions, for whichever process
 *                      of each shard: its number and how many follow
 *                          a byte each: is it put to this shard alone?
 *                          rows of doubles; directions; or of each range its parts
 *     of answers       of each shard, in the same order: how many; the number of the first bad question, or that of
 *                      all, and its diagnostic if there is one
 *                          of each question: how many, 4 bytes
 *                          of each answer its tag; then of each its object, 4 bytes; then, where answers have values,
 *                          of each its value; where they are only counted, none of these */
#ifndef FROE_SHARDS_LETTERS_H
#define FROE_SHARDS_LETTERS_H
#include "shards/ask/share.h"

/** What is left of the words of a process. */
typedef struct shards_letter {
    const unsigned char *at;
    size_t left;
} shards_letter;
/** The next words. False: they are not there. */
bool shards_letter_words(shards_letter *letter, uint64_t *words, size_t count);
/** FROE_E_FORMAT: words are missing. */
froe_status shards_letter_cut(froe_diagnostic *diag);

/** Questions that a process has for a shard, as its owner asks them, and what was found for them. */
typedef struct shards_list {
    uint32_t process, shard;
    size_t count;
    const bool *alone;
    const double *points, *directions; /**< in the words that came */
    froe_range *ranges;                /**< or NULL; its arrays lie in the words that came */
    const size_t *which;               /**< of this process's own questions, their numbers; then nothing else here */
    size_t limit;                      /**< as in shards_call */
    froe_diagnostic bad;
    uint32_t *counts; /**< answers of each question */
    ARRAY(uint64_t) tags;
    ARRAY(uint32_t) objects;
    ARRAY(double) values;
} shards_list;
void shards_list_free(const froe_allocator *alloc, shards_list *list);

/** Words of the questions that are listed for a shard, for the process whose count this is. False: no memory. */
bool shards_put_questions(shards_share *share, size_t *count, const shards_question *q, uint32_t shard,
                          const size_t *which, const bool *alone, size_t questions);
/** The questions of the next shard. FROE_E_FORMAT, FROE_E_MEMORY; free the list either way. */
froe_status shards_take_questions(shards_letter *letter, const shards_call *call, shards_list *out,
                                  froe_diagnostic *diag);
/** Words of what was found. False: no memory. */
bool shards_put_answers(shards_share *share, size_t *count, const shards_list *list);
/** Takes what another process has found in a shard for the questions that were sent to it. */
froe_status shards_take_answers(shards_call *call, shards_letter *letter, uint32_t shard, const size_t *which,
                                size_t questions, froe_diagnostic *diag);
#endif
