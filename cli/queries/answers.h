/* answers.h: rows of answers on standard output, millions of them. */
#ifndef FROE_CLI_ANSWERS_H
#define FROE_CLI_ANSWERS_H
#include <froe/query.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct cli_answers {
    uint64_t rows; /**< written so far */
    bool mute;     /**< count them only */
    size_t length;
    char text[1 << 16];
} cli_answers;

/** Cells of a row, in order; cli_answers_end() ends it. */
void cli_answers_whole(cli_answers *out, uint64_t value);
void cli_answers_real(cli_answers *out, double value); /**< with the digits that reading it back needs */
void cli_answers_text(cli_answers *out, const char *value);
void cli_answers_name(cli_answers *out, const char *value); /**< any text, quoted where CSV needs it */
void cli_answers_none(cli_answers *out);                    /**< an empty cell */
void cli_answers_end(cli_answers *out);
/** A row "first,second". */
void cli_answers_pair(cli_answers *out, uint64_t first, uint64_t second);
/** Puts the ids of each query in ascending order. */
void cli_answers_sort(froe_answers *answers);
/** All answers of a batch, as "id,object" by id, then object, or as "id,count". */
void cli_answers_lists(cli_answers *out, const uint64_t *ids, froe_answers *answers, bool count);
/** Hands everything to standard output; cli_flush() says whether it arrived. */
void cli_answers_flush(cli_answers *out);
#endif
