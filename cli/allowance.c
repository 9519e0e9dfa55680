/* allowance.c: see allowance.h. */
#define _DEFAULT_SOURCE 1 /* setitimer */
#include "allowance.h"
#include "exit.h"
#include <inttypes.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdio.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

enum { MEGABYTE = 1000000 };

/* Bytes of addresses that the program has; 0 where the system does not tell. */
static uint64_t mapped_now(void) {
    uint64_t pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file) return 0;
    if (fscanf(file, "%" SCNu64, &pages) != 1) pages = 0;
    fclose(file);
    return pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

/* The system's own limit, which may be lower, stays. */
static bool set_limit(uint64_t bytes) {
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit)) return false;
    if (limit.rlim_max == RLIM_INFINITY || bytes < limit.rlim_max) limit.rlim_cur = (rlim_t)bytes;
    return setrlimit(RLIMIT_AS, &limit) == 0;
}

int cli_limit(const cli_common *common) {
    if (common->limit_memory) {
#ifdef __GLIBC__
        (void)mallopt(M_ARENA_MAX,
                      1); /* one for each thread would reserve 64 MB of addresses, which the limit counts */
#endif
        const uint64_t mapped = mapped_now();
        if (!mapped || !set_limit(mapped + common->limit_memory * MEGABYTE))
            return cli_fail(CLI_RESOURCES, NULL, "--limit-memory: The system does not limit memory.");
    }
    if (!common->limit_time) return 0;
    const struct itimerval timer = {.it_value.tv_sec = (time_t)common->limit_time, .it_interval.tv_sec = 1};
    if (setitimer(ITIMER_REAL, &timer, NULL) == 0) return 0;
    return cli_fail(CLI_RESOURCES, NULL, "--limit-time: The system does not limit time.");
}

cli_limits cli_limit_pause(void) {
    struct rlimit limit;
    cli_limits out = {0};
    if (getrlimit(RLIMIT_AS, &limit) || limit.rlim_cur == limit.rlim_max) return out;
    out = (cli_limits){.limited = true, .limit = (uint64_t)limit.rlim_cur, .mapped = mapped_now()};
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_AS, &limit);
    return out;
}

void cli_limit_resume(cli_limits limits) {
    if (limits.limited) (void)set_limit(limits.limit + (mapped_now() - limits.mapped));
}
