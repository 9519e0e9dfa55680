/* contest.h: how well "auto" chooses. */
#ifndef FROE_CLI_COMPARE_CONTEST_H
#define FROE_CLI_COMPARE_CONTEST_H
#include <froe/froe.h>
#include <jansson.h>

/** For each purpose {"auto", "best", "ratio"}: the method that auto takes, the one that came out best, and how many
 * times its cost that of auto is; ratio null: auto's own row failed or is not there. The cost of pieces and draw is
 * fragments, among trees with leaves of one object at most (or more that nothing
 * separates); that of query the mean over kinds of queries of microseconds relative to the quickest; best and ratio are
 * null without times. */
json_t *contest_json(const froe_scene *scene, const json_t *rows);
/** Over all scenes, for each purpose {"scenes", "best", "within_10_percent", "failed", "worst_ratio"}: "failed" where
 * the method of auto gave no tree but another did; "scenes" has these and those with a ratio. */
json_t *contest_sum_json(const json_t *scenes);
#endif
