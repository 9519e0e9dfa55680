/* output.c: see output.h. */
#define _GNU_SOURCE 1 /* sync_file_range */
#include "output.h"
#include "support/fail.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* All ranks open the file that rank 0 has made, if there is one. */
static froe_status open_draft(mpi_output *o, froe_diagnostic *diag) {
    const char *draft = o->writing ? support_writer_draft(&o->writer) : NULL;
    char name[PATH_MAX + 64] = "";
    if (draft) snprintf(name, sizeof name, "%s", draft);
    MPI_Bcast(name, sizeof name, MPI_CHAR, 0, o->ranks->comm);
    if (!*name) return FROE_OK;
    o->file = open(name, O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
    return mpi_agree(o->ranks, o->file < 0 ? support_fail_file(diag, "written", name, errno) : FROE_OK, diag);
}

froe_status mpi_output_open(const mpi_ranks *ranks, const char *path, mpi_output *o, froe_diagnostic *diag) {
    froe_status status = FROE_OK;
    *o = (mpi_output){.ranks = ranks, .path = path, .file = -1};
    if (!path) return status;
    if (!ranks->rank) status = support_writer_open_shared(&o->writer, path, NULL, diag);
    o->writing = !ranks->rank && !status;
    status = mpi_agree(ranks, status, diag);
    if (!status) status = open_draft(o, diag);
    return status ? mpi_output_close(o, status, diag) : FROE_OK;
}

/* ------------------------------------------------------------------ writing -- */

/* Returns an errno. */
static int write_at(int file, const char *text, size_t count, uint64_t place) {
    const off_t begin = (off_t)place;
    const size_t all = count;
    while (count) {
        const ssize_t wrote = pwrite(file, text, count, (off_t)place);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote <= 0) return wrote ? errno : ENOSPC;
        text += wrote, place += (uint64_t)wrote, count -= (size_t)wrote;
    }
#ifdef SYNC_FILE_RANGE_WRITE /* the disk begins now, so that there is less to wait for at the end */
    if (all) (void)sync_file_range(file, begin, (off_t)all, SYNC_FILE_RANGE_WRITE);
#endif
    return 0;
}

static froe_status put_at_places(mpi_output *o, const char *text, size_t count, froe_diagnostic *diag) {
    const int error = write_at(o->file, text, count, o->length + mpi_sum_before(o->ranks, count));
    o->length += mpi_sum(o->ranks, count);
    return error ? support_fail_file(diag, "written", o->path, error) : FROE_OK;
}

static bool put_by_rank_0(mpi_output *o, const char *text, size_t count) {
    return o->path ? support_writer_put(&o->writer, text, count) : fwrite(text, 1, count, stdout) == count;
}

/* Rank 0 writes the texts of all, a piece at a time. */
static froe_status put_in_turn(mpi_output *o, const char *text, size_t size, froe_diagnostic *diag) {
    enum { PIECE = 1 << 16 };
    char piece[PIECE]; /* rank 0 cannot fail before it has received what the others send */
    const MPI_Comm comm = o->ranks->comm;
    uint64_t count = size;
    if (o->ranks->rank) {
        MPI_Send(&count, 1, MPI_UINT64_T, 0, 0, comm);
        for (uint64_t at = 0; at < count; at += PIECE)
            MPI_Send(text + at, (int)(count - at < PIECE ? count - at : PIECE), MPI_CHAR, 0, 0, comm);
        return FROE_OK;
    }
    bool ok = put_by_rank_0(o, text, size);
    for (int r = 1; r < o->ranks->count; r++) {
        MPI_Recv(&count, 1, MPI_UINT64_T, r, 0, comm, MPI_STATUS_IGNORE);
        for (uint64_t at = 0; at < count; at += PIECE) {
            const size_t some = count - at < PIECE ? (size_t)(count - at) : PIECE;
            MPI_Recv(piece, (int)some, MPI_CHAR, r, 0, comm, MPI_STATUS_IGNORE);
            ok = ok && put_by_rank_0(o, piece, some);
        }
    }
    if (o->path) return ok ? FROE_OK : support_fail_file(diag, "written", o->path, o->writer.error);
    ok = !fflush(stdout) && ok;
    return ok ? FROE_OK : support_fail(diag, FROE_E_LIMIT, "Standard output cannot be written.");
}

froe_status mpi_output_put(mpi_output *o, const char *text, size_t count, froe_diagnostic *diag) {
    const froe_status status = o->file < 0 ? put_in_turn(o, text, count, diag) : put_at_places(o, text, count, diag);
    return mpi_agree(o->ranks, status, diag);
}

/* ------------------------------------------------------------------- ending -- */

/* Brings what this rank has written to the disk; returns an errno. */
static int close_own(int file, bool keep) {
    int error = keep && fsync(file) && errno != EINVAL && errno != EROFS && errno != ENOTSUP ? errno : 0;
    if (close(file) && errno != EINTR && !error) error = errno;
    return error;
}

froe_status mpi_output_close(mpi_output *o, froe_status status, froe_diagnostic *diag) {
    const int error = o->file < 0 ? 0 : close_own(o->file, !status);
    if (error && !status) status = support_fail_file(diag, "written", o->path, error);
    status = mpi_agree(o->ranks, status, diag);
    if (o->writing) {
        o->writer.diag = diag;
        status = support_writer_close(&o->writer, status);
    }
    return mpi_agree(o->ranks, status, diag);
}
