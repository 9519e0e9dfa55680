/* trace.h: where the pieces of an object must be, found from the cuts alone.
 *
 * The object is carried from the root and clipped exactly by every cut it meets. Cells are open,
 * objects closed and convex: what has a point strictly on a side goes there, what lies in the
 * cut ends there, and touching a cut from one side is being on that side only.
 *
 * Points, segments and polygons are traced exactly, and so are boxes and balls among axis-parallel cuts. For the
 * rest, whether a solid reaches into a cell that cuts bound from several sides is enclosed: it MAY be listed wherever
 * no single cut excludes it, and MUST be where a point of it is known to lie, or is found (trace_cell.c).
 *
 * A box that contains the region of a node may be listed there, as a cover, in place of all lists below. Every node on
 * the way of a box is asked for that. Below the node the box has no place. The axis-parallel cuts above a node bound
 * its region; a box within whose sides each of these bounds is contains it, whatever oblique cuts there are besides.
 *
 * This is the audit's own clipping: it shares the predicates with the builders, nothing else.
 *
 * It speaks for trace.c, trace_cell.c, trace_solid.c and audit.c, which compares the places with the tree. */
#ifndef FROE_TREE_AUDIT_TRACE_H
#define FROE_TREE_AUDIT_TRACE_H
#include "base/apart.h"
#include "geom/predicates.h"
#include "tree/ring.h"

/** A place for a piece: a leaf, or an inner node in whose cut it lies. */
typedef struct trace_place {
    uint32_t node;
    bool must;            /**< false: allowed only, unless ... */
    bool unsure;          /**< ... trace_cell_meets() says that it must */
    const uint32_t *ring; /**< the fragment there, as in tree.h; NULL: kinds that are not cut */
    uint32_t count;
} trace_place;
/** False stops the trace. */
typedef bool trace_fn(void *user, const trace_place *place);
/** Is the object, a box, listed as a cover of the node? The trace then does not go below it. contains: does it contain
 * the region? If not, though it is listed so, *stop is set. */
typedef bool trace_cover_fn(void *user, uint32_t node, bool contains, bool *stop);

/** A corner of the part being carried: the edge that leaves it (segments: what ends it there) and an image. */
typedef struct trace_corner {
    double x[3], error;
    uint32_t edge;
} trace_corner;

/** A part waiting for its turn: a run of corners. */
typedef struct trace_part {
    uint32_t node, first, count;
} trace_part;

/** A solid waiting: its part within the axis-parallel cuts above, and what is certain of it. */
typedef struct trace_solid {
    uint32_t node, first, count; /* hulls: corners certainly inside */
    bool oblique;                /* is there an oblique cut above? (boxes) */
    bool exact;                  /* no oblique cut has divided it */
    bool inside;                 /* a witness is inside: a point of boxes, the centre of balls */
    uint16_t bounded; /* boxes: bits 2 k, 2 k + 1: does a cut bound the region below and above on axis k, not beyond
                         the side of the box? */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM]; /* boxes: the part; balls: the cell */
    double witness[FROE_MAX_DIM];
} trace_solid;

/** Planes of the nodes met last: neighbouring objects take the same paths. */
#define TRACE_PLANES 512
typedef struct trace_planes {
    uint32_t id1[TRACE_PLANES]; /* node + 1, 0: free */
    geom_plane plane[TRACE_PLANES];
} trace_planes;

/** What tracing works with; one per thread. */
typedef struct tree_trace {
    const froe_tree *tree;
    froe_allocator alloc;
    num_context context;
    trace_planes *planes;
    trace_fn *fn;
    trace_cover_fn *cover_fn;
    void *user;
    uint32_t object;
    bool stopped;
    ARRAY(trace_corner) corners;
    ARRAY(trace_part) parts;
    ARRAY(trace_solid) solids;
    ARRAY(int8_t) sides;
    ARRAY(uint32_t) ring;
    base_apart apart;
} tree_trace;

froe_status trace_new(const froe_tree *tree, bool exact_only, tree_trace *out);
void trace_free(tree_trace *t);
/** Visits all places of one object, in the order of the lists; covers: asked for boxes. FROE_E_MEMORY. */
froe_status trace_object(tree_trace *t, uint32_t object, trace_fn *fn, trace_cover_fn *covers, void *user);

/** The plane of a node's cut; good until the next call. */
const geom_plane *trace_plane(tree_trace *t, uint32_t node);
/** Does the object, a solid, certainly meet the open cell of a leaf? *meets is not changed where images of cuts are
 * too rough, and above dimension 3 below oblique cuts that divide the object. FROE_E_MEMORY. */
froe_status trace_cell_meets(tree_trace *t, uint32_t leaf, bool *meets);
/** The same as trace_object for boxes, balls and hulls; called by it. */
froe_status trace_solid_object(tree_trace *t);
#endif
