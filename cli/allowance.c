/* allowance.c: see allowance.h. */
#define _DEFAULT_SOURCE 1 /* setitimer */
#include "allowance.h"
#include "exit.h"
#include <errno.h>
#include <inttypes.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdio.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

enum { MEGABYTE = 1000000 };
static const char addresses[] = "/proc/self/statm";

/* Bytes of addresses that the program has; 0 where the system does not tell, and errno. */
static uint64_t mapped_now(void) {
    uint64_t pages = 0;
    FILE *file = fopen(addresses, "r");
    if (!file) return 0;
    errno = EIO;
    if (fscanf(file, "%" SCNu64, &pages) != 1) pages = 0;
    const int error = errno;
    fclose(file);
    errno = error;
    return pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

/* The system's own limit, which may be lower, stays. */
static bool set_limit(uint64_t bytes) {
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit)) return false; /* one way: Linux knows this limit */
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
        if (!mapped) return cli_fail_file(CLI_RESOURCES, addresses, "read");
        if (!set_limit(mapped + common->limit_memory * MEGABYTE)) /* one way: a limit may be lowered */
            return cli_fail(CLI_RESOURCES, NULL, "--limit-memory: The system does not limit memory.");
    }
    if (!common->limit_time) return 0;
    const struct itimerval timer = {.it_value.tv_sec = (time_t)common->limit_time, .it_interval.tv_sec = 1};
    if (setitimer(ITIMER_REAL, &timer, NULL) == 0) return 0; /* one way: no such time is refused */
    return cli_fail(CLI_RESOURCES, NULL, "--limit-time: The system does not limit time.");
}

cli_limits cli_limit_pause(void) {
    struct rlimit limit;
    cli_limits out = {0};
    if (getrlimit(RLIMIT_AS, &limit)) return out; /* one way: as in set_limit() */
    if (limit.rlim_cur == limit.rlim_max) return out;
    out = (cli_limits){.limited = true, .limit = (uint64_t)limit.rlim_cur, .mapped = mapped_now()};
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_AS, &limit);
    return out;
}

void cli_limit_resume(cli_limits limits) {
    if (limits.limited) (void)set_limit(limits.limit + (mapped_now() - limits.mapped));
}
