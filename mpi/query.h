/* query.h: the questions of froe-mpi, which are those of the commands of froe that are called alike: their columns, the
 * call that answers them, and the rows of their answers. */
#ifndef FROE_MPI_QUERY_H
#define FROE_MPI_QUERY_H
#include "cli/queries/answers.h"
#include "cli/queries/rows.h"
#include "ranks.h"

typedef enum mpi_command { MPI_RANGE, MPI_LOCATE, MPI_NEAR, MPI_RAY, MPI_NO_COMMAND } mpi_command;

/** What is asked, as options say it. */
typedef struct mpi_query {
    mpi_command command;
    froe_range_shape shape;   /**< of range; one row each */
    bool count;               /**< how many answers each has */
    bool above, below;        /**< of locate: segments in sight */
    bool all;                 /**< of ray: not the first alone */
    size_t k;                 /**< of near */
    double within, t_max;     /**< of near and ray; infinite: no limit */
    froe_batch_options batch; /**< with threads */
} mpi_query;

/** The command of that name. */
mpi_command mpi_command_named(const char *name);
/** The shape of that name, if ranges of one row have it. */
bool mpi_shape_named(const char *name, froe_range_shape *out);
const cli_column *mpi_query_columns(const mpi_query *q);
/** The names of the columns of answers, *count of them. */
const char *const *mpi_query_names(const mpi_query *q, size_t *count);

/** Answers of a batch: how many each has, or one object each, or lists. --count of first hits has objects. */
typedef struct mpi_answers {
    uint64_t *counts;  /**< NULL: objects */
    froe_find *firsts; /**< NULL: lists */
    froe_finds lists;
} mpi_answers;
/** Collective. Asks `count` questions of `width` numbers each; the status is this rank's own. */
froe_status mpi_query_ask(const mpi_ranks *ranks, const mpi_query *q, froe_shards *shards, const double *rows,
                          size_t width, size_t count, mpi_answers *out, froe_diagnostic *diag);
/** Writes the rows of answers. `first`: the number of the first question. */
void mpi_query_put(const mpi_query *q, const mpi_answers *answers, size_t count, uint64_t first, cli_answers *out);
void mpi_answers_free(mpi_answers *answers);
#endif
