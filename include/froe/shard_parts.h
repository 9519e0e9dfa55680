/* shard_parts.h: the steps by which a folder of shards is built, for programs that spread them over machines.
 *
 * froe_shards_begin(), _add() and _finish() of froe/shards.h take these steps one after the other. A program of several
 * processes takes them in each, and gets the same folder, byte for byte:
 *
 *     froe_shard_draft_begin()      one process          the folder in which the new one grows
 *     froe_shard_records_add()      each, of its objects objects as bytes
 *     froe_shard_sample_add()       each, of its records what cells are cut by; then all samples are merged
 *     froe_shard_plan_new()         each, of all samples the cells, the same in each process
 *     froe_shard_plan_cells()       each, of its records to which shards an object goes: whose cells its box meets
 *     froe_shard_buckets_add()      the owner of a shard what has arrived, in any order
 *     froe_shard_build()            the owner of a shard its file and its entry
 *     froe_shard_report()           who has all entries  counts of the whole folder
 *     froe_shard_manifest_write()   one process          the text that names all shards
 *     froe_shard_draft_sync()       each                 its own files are on the disk
 *     froe_shard_draft_place()      one process              the new folder takes the place of the old one
 *     froe_shard_draft_clear()      each                 part of the old folder goes away
 *     froe_shard_draft_end()        one process          the rest of it goes away
 *
 * Nothing depends on the order in which objects come, nor on which process has them. docs/design/shards.md explains
 * why, and docs/format.md the files. Calls on different things may run at the same time. */
#ifndef FROE_SHARD_PARTS_H
#define FROE_SHARD_PARTS_H
#include <froe/shards.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ----------------------------------------------------------------- records -- */

/** Objects as bytes, a record behind the other. Begin with {.alloc = ...} and zeros; alloc zero: malloc. Every record
 * takes a multiple of 8 bytes; a segment of the plane takes 48. Bytes may be copied, sent and put together as
 * they like, whole records at a time; they mean the same on all machines with the same order of bytes. */
typedef struct froe_shard_records {
    unsigned char *bytes;
    size_t count, capacity; /**< in bytes */
    froe_allocator alloc;
} froe_shard_records;
/** Appends the objects of a batch. Without tags they have the tags first, first + 1, ...; faces and groups are numbers
 * of the whole folder. All of it, or on failure none of it. FROE_E_INPUT: as froe_scene_add(). FROE_E_MEMORY,
 * FROE_E_ARG, FROE_E_OPTIONS, FROE_E_UNSUPPORTED, FROE_E_LIMIT: an object of more than 2^31 bytes. */
FROE_API froe_status froe_shard_records_add(froe_shard_records *records, int dim, const froe_objects *batch,
                                            uint64_t first, froe_diagnostic *diag);
/** Appends bytes that are whole records, some of its own, too. FROE_E_MEMORY. */
FROE_API froe_status froe_shard_records_append(froe_shard_records *records, const void *bytes, size_t count,
                                               froe_diagnostic *diag);
FROE_API void froe_shard_records_free(froe_shard_records *records);
/** How many bytes the record takes that begins here, of which `left` are there. 0: it is not there as a whole, or is no
 * record. Whether its numbers are those of an object is for froe_shard_sample_add() and froe_shard_build() to say. The
 * bytes are aligned as doubles are. */
FROE_API size_t froe_shard_record_size(const void *bytes, size_t left);
/** The box of a record, which froe_shard_record_size() has found: dim doubles each, those of balls rounded outwards. */
FROE_API void froe_shard_record_box(const void *record, double *lo, double *hi);

/* ------------------------------------------------------------------ sample -- */

/** Some of the objects, drawn by a hash of box and tag, so that all orders and all ways to divide the objects give the
 * same sample; with counts of all objects. At most 2^17 are kept, in 9 MB in the plane. */
typedef struct froe_shard_sample froe_shard_sample;
FROE_API froe_status froe_shard_sample_new(int dim, const froe_allocator *alloc, froe_shard_sample **out);
FROE_API void froe_shard_sample_free(froe_shard_sample *sample);
/** Counts whole records, and keeps those that are drawn. FROE_E_MEMORY; FROE_E_ARG: one is no record, is of another
 * dimension, or has a number that is not finite. Those before it are counted. */
FROE_API froe_status froe_shard_sample_add(froe_shard_sample *sample, const void *records, size_t count);
/** Of a sample of part of the objects, which is one of `parts`: a hash for froe_shard_sample_cut(). The largest of
 * those of all parts leaves in them together what is in the sample of all, and little more. */
FROE_API uint64_t froe_shard_sample_bound(froe_shard_sample *sample, uint32_t parts);
/** Drops those objects from a sample whose hash is above a bound. They are counted all the same. */
FROE_API void froe_shard_sample_cut(froe_shard_sample *sample, uint64_t bound);
/** The sample as words, to be sent to other processes of the same order of bytes. They belong to the sample, and are
 * valid until its next call. */
FROE_API const uint64_t *froe_shard_sample_words(froe_shard_sample *sample, size_t *count);
/** Adds a sample that came as words. FROE_E_ARG: it is none of the same dimension, or not all of its words are there.
 * FROE_E_MEMORY: part of it may be added. */
FROE_API froe_status froe_shard_sample_merge(froe_shard_sample *sample, const uint64_t *words, size_t count);

/* -------------------------------------------------------------------- plan -- */

/** Cells, which are closed boxes that fill space, by cuts along the axes at medians of a sample. */
typedef struct froe_shard_plan froe_shard_plan;
/** Cuts space into `shards` cells (0: so many that building one by one takes `memory` bytes), or fewer where the sample
 * has not so many different places. memory 0: 4 GiB. FROE_E_ARG: more than FROE_SHARDS_MOST. FROE_E_LIMIT: so little
 * memory would take more shards than that. FROE_E_MEMORY. The sample is as it was. */
FROE_API froe_status froe_shard_plan_new(froe_shard_sample *sample, uint32_t shards, uint64_t memory,
                                         froe_shard_plan **out, froe_diagnostic *diag);
FROE_API void froe_shard_plan_free(froe_shard_plan *plan);
FROE_API uint32_t froe_shard_plan_count(const froe_shard_plan *plan);
/** The cells that a box meets, ascending: writes their numbers, at most froe_shard_plan_count() of them, and returns
 * how many these are, at least 1. O(log of the number of cells) for each. */
FROE_API uint32_t froe_shard_plan_cells(const froe_shard_plan *plan, const double *lo, const double *hi,
                                        uint32_t *cells);

/* ----------------------------------------------------------------- buckets -- */

/** Bytes that come in any order and belong to one of several buckets, in a file of the folder that has no name, so that
 * nothing is left of it whatever happens. Memory: 64 MB at most. */
typedef struct froe_shard_buckets froe_shard_buckets;
/** FROE_E_IO, FROE_E_MEMORY; FROE_E_ARG: no bucket, or more than FROE_SHARDS_MOST. `folder` is copied. */
FROE_API froe_status froe_shard_buckets_new(const char *folder, uint32_t count, const froe_allocator *alloc,
                                            froe_shard_buckets **out, froe_diagnostic *diag);
FROE_API void froe_shard_buckets_free(froe_shard_buckets *buckets);
/** Appends whole records to a bucket. FROE_E_IO (the disk is full), FROE_E_MEMORY; then the buckets can only be
 * freed. */
FROE_API froe_status froe_shard_buckets_add(froe_shard_buckets *buckets, uint32_t bucket, const void *records,
                                            size_t count, froe_diagnostic *diag);
/** Receives whole records; anything but FROE_OK ends the call, which returns it and leaves the diagnostic to the
 * function. */
typedef froe_status froe_shard_records_fn(void *user, const void *records, size_t count);
/** Hands the records of a bucket to a function, in the order they came, and empties it: its place on the disk is given
 * back as it goes, where the system can do that. FROE_E_IO, FROE_E_MEMORY. FROE_E_FORMAT: bytes that are no whole
 * records were added; those in front of them have been handed over. */
FROE_API froe_status froe_shard_buckets_take(froe_shard_buckets *buckets, uint32_t bucket, froe_shard_records_fn *fn,
                                             void *user, froe_diagnostic *diag);

/* ------------------------------------------------------------------- shard -- */

/** What a manifest says of a shard. */
typedef struct froe_shard_entry {
    uint64_t objects;                          /**< in its file; 0: it has none */
    uint64_t own;                              /**< of these, those that no shard before it has */
    uint64_t bytes;                            /**< of its file */
    uint64_t check;                            /**< the checksum of its file's header, which holds all others */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM]; /**< bounds of its objects' boxes within its cell; 0 without objects */
} froe_shard_entry;
/** Builds shard `cell` from its records in any order, and saves it as FOLDER/shard-NNNN.froe. The file may reach the
 * disk later, before the draft comes to its place. The records are emptied
 * on the way, to save memory, and freed by the caller. Objects have the order of their tags in it, and those of equal
 * tags the order of their records' bytes. `scene` (may be NULL) gives coordinate system, upward axis and groups. Of
 * options, see froe_shards_options, `shards` and `memory` are ignored. FROE_E_INPUT names the tag of an object that is
 * none, or whose group the scene has not. FROE_E_ARG: bytes that are no record of the plan's dimension, or an object
 * that does not meet the cell; otherwise as froe_build() and froe_tree_save(). */
FROE_API froe_status froe_shard_build(froe_shard_records *records, const froe_shard_plan *plan, uint32_t cell,
                                      const froe_scene *scene, const froe_shards_options *options, const char *folder,
                                      froe_shard_entry *out, froe_diagnostic *diag);
/** What a folder of these shards is; entries: as many as there are cells. O(cells). */
FROE_API froe_shards_report froe_shard_report(const froe_shard_plan *plan, const froe_shard_entry *entries);
/** Writes FOLDER/froe.shards; entries: as many as there are cells. FROE_E_IO, FROE_E_MEMORY. */
FROE_API froe_status froe_shard_manifest_write(const froe_shard_plan *plan, const froe_shard_entry *entries,
                                               const char *folder, const froe_allocator *alloc, froe_diagnostic *diag);

/* ------------------------------------------------------------------- draft -- */

/** A folder .NAME.building beside the one to be made, NAME, which it replaces at the end. What a killed program left of
 * such a folder goes away when NAME is built the next time. */
typedef struct froe_shard_draft froe_shard_draft;
/** FROE_E_IO: the folder cannot be written, something else than a folder of shards is there, or another program is
 * building it. FROE_E_MEMORY. */
FROE_API froe_status froe_shard_draft_begin(const char *path, const froe_allocator *alloc, froe_shard_draft **out,
                                            froe_diagnostic *diag);
/** Where the files go; lives as long as the draft. */
FROE_API const char *froe_shard_draft_folder(const froe_shard_draft *draft);
/** Waits until part `part` of `parts` of the shards in a draft's folder is on the disk: shard s is of part s modulo
 * `parts`. Each process does so with its own before froe_shard_draft_place(), which does so with all that are left.
 * FROE_E_IO. */
FROE_API froe_status froe_shard_draft_sync(const char *folder, uint32_t part, uint32_t parts, froe_diagnostic *diag);
/** Brings the draft to its place. *replaced: what was there is now at froe_shard_draft_folder(), under a lock, until
 * froe_shard_draft_end() removes it. FROE_E_IO: everything is as it was. */
FROE_API froe_status froe_shard_draft_place(froe_shard_draft *draft, bool *replaced, froe_diagnostic *diag);
/** Removes part `part` of `parts` of the shards in a folder that was replaced, which takes the system some time: any
 * process may, between froe_shard_draft_place() and froe_shard_draft_end(). */
FROE_API void froe_shard_draft_clear(const char *folder, uint32_t part, uint32_t parts);
/** With FROE_OK as status: brings the draft to its place, if froe_shard_draft_place() has not, and removes the folder
 * that was there. Otherwise removes the draft, if it is not in its place. Frees it either way. Returns `status`, or
 * FROE_E_IO. */
FROE_API froe_status froe_shard_draft_end(froe_shard_draft *draft, froe_status status, froe_diagnostic *diag);

/* --------------------------------------------------------------------- ask -- */

/** Sends bytes to processes, and receives what they have sent to this one: those for process 0 come first in `out`,
 * counts[0] of them, then those for process 1, and so on. What is received goes into `in`, which is empty, in the same
 * way; its memory comes from in->alloc. All counts are multiples of 8. `status` says whether this process has failed,
 * and diag, which is never NULL, why. If one has, nothing is sent, and all processes return the failure and diagnostic
 * of the first that has. All of them call it at the same time. FROE_OK says that all bytes have come as they were sent,
 * to all processes. Where some are lost all the same, questions mostly end in FROE_E_FORMAT; but a process that lacks
 * the first words of a last exchange waits for another one for ever. So the function, like MPI, has to notice what is
 * lost, and that another process has ended; it returns a failure in all processes then, or ends them. */
typedef froe_status froe_shards_trade_fn(void *user, froe_status status, const froe_shard_records *out,
                                         const size_t *counts, froe_shard_records *in, size_t *in_counts,
                                         froe_diagnostic *diag);
/** Which of `count` processes has a shard: they take turns, and each turn begins with the next process, because every
 * second or fourth shard is often one of a crowded side, and takes longer.
 *
 *     shard      0 1 2 | 3 4 5 | 6 7 8 | 9 ...
 *     process    0 1 2 | 1 2 0 | 2 0 1 | 0 ...
 *
 * 0: count is 0. */
FROE_API uint32_t froe_shard_owner(uint32_t shard, uint32_t count);
/** The shard that a process has of turn 0, 1, ...: there is none where it is not below the number of shards, nor in any
 * later turn. */
FROE_API uint32_t froe_shard_of_turn(uint32_t process, uint32_t count, uint32_t turn);
/** Lets `count` processes that have opened the same folder ask it together: a shard is asked by its froe_shard_owner(),
 * and by no other. From now on the processes make each call that asks (froe/shards.h) together, with questions
 * of their own, perhaps none, and the same other arguments. Each gets the answers to its own questions, as it would
 * have got them alone. A bad question is a failure of the process that has it. Any other failure is one of all
 * processes, but for one behind the last exchange, so that they have to compare what the calls returned.
 * froe_shards_pairs() tells those of the process's own shards, and froe_shards_groups_join() is FROE_E_UNSUPPORTED.
 * `count` 1: alone again. FROE_E_ARG, FROE_E_MEMORY. */
FROE_API froe_status froe_shards_share(froe_shards *shards, uint32_t rank, uint32_t count, froe_shards_trade_fn *trade,
                                       void *user, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
