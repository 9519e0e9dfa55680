/* assimp_nodes.h: the nodes of a model that assimp has read, in a list, and what may be done to them before the corners
 * of their meshes are read. It speaks for read_assimp.c. */
#ifndef FROE_IO_ASSIMP_NODES_H
#define FROE_IO_ASSIMP_NODES_H
#include "readers.h"
#include <assimp/scene.h>

typedef struct io_node {
    const struct aiNode *node; /**< lives as long as the reader runs */
    size_t parent;             /**< SIZE_MAX: none */
    double at[12];             /**< rows of a 3 x 4 matrix: from its meshes to space */
    size_t first;              /**< the first object of its meshes in the scene; the last one's are those up to the next
                                    node's */
} io_node;
typedef ARRAY(io_node) io_nodes;

/** May change `at` of each node. Parents come before their children, whose order is the file's. */
typedef froe_status io_arrange_fn(void *user, const formats_source *source, formats_sink *sink,
                                  const struct aiScene *scene, io_nodes *nodes);
/** As io_read_assimp(), with such a function in between. The list is the caller's; nodes are gone afterwards. */
froe_status io_read_arranged(const formats_source *source, formats_sink *sink, io_nodes *nodes, io_arrange_fn *arrange,
                             void *user);
/** out = a b, of 3 x 4 matrices; out is another. */
void io_matrix_multiply(const double a[12], const double b[12], double out[12]);
#endif
