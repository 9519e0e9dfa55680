/* serve.h: what processes ask of the shards of this one; see share.h. */
#ifndef FROE_SHARDS_SERVE_H
#define FROE_SHARDS_SERVE_H
#include "shards/ask/share.h"

/** Answers what came, into `out`, and the questions of this process itself for its own shards, which are listed as for
 * shards_call_all(). *more: has any process questions? */
froe_status shards_serve(shards_call *call, const size_t *starts, const size_t *which, const bool *alone, bool *more,
                         froe_diagnostic *diag);
#endif
