/* faults.h: the system calls that write files, and those that read them, which fail on demand.
 *
 * The linker leads every call of the functions in cmake/FroeTests.cmake to faults.c (--wrap), in a test or in the
 * program. Calls are counted from 1 where they belong to an output: a file or folder opened for it. The program reads
 * FROE_FAULT, "NUMBER KIND", and FROE_FAULT_LOG, a descriptor that gets a line for each call.
 *
 * reads.c does the same for calls that read, FROE_FAULT_READS; memory.c for calls that give memory, FROE_FAULT_MEMORY,
 * and for those that tell of progress, FROE_FAULT_STEPS. FROE_FAULT_COUNTS is a descriptor that gets their numbers in
 * the end; FROE_FAULT_PLACES is one that gets a line for each call for memory: its number, and which functions ask. */
#ifndef FROE_TESTS_FAULTS_H
#define FROE_TESTS_FAULTS_H
#include <stdbool.h>
#include <stdio.h>

typedef enum fault_kind {
    FAULT_NONE,
    FAULT_EIO,        /* this call fails: Input/output error */
    FAULT_ENOSPC,     /* No space left on device */
    FAULT_EINTR,      /* Interrupted system call */
    FAULT_SHORT,      /* write() writes, or read() reads, one byte only */
    FAULT_FOREVER,    /* this call and all after it: Input/output error */
    FAULT_KILL,       /* kill -9 instead of this call */
    FAULT_INTERRUPT,  /* Ctrl-C, then the call */
    FAULT_TERMINATE,  /* kill, then the call */
    FAULT_LATE,       /* the time of --limit-time is over, then the call */
    FAULT_END,        /* read() finds the end of the file */
    FAULT_FULL,       /* this call and all after it that need room: No space left on device */
    FAULT_POWER,      /* the power is lost instead of this call (power.h) */
    FAULT_POWER_BACK, /* so it is, and names are what they were before */
    FAULT_KINDS
} fault_kind;

typedef struct fault_plan {
    unsigned at; /* the number of the call; 0: none */
    fault_kind kind;
    unsigned calls;        /* so far */
    const char *names[64]; /* of the first calls: "open", "write", "fsync folder" */
    int log;               /* a descriptor; -1: none */
    unsigned zeros;        /* so many random numbers are 0 */
} fault_plan;

extern fault_plan faults, fault_reads;

/* "NUMBER KIND" of a variable of the environment. */
void fault_plan_read(fault_plan *plan, const char *variable);
/* Counts a call; true when it shall fail, with errno. */
bool fault_meets(fault_plan *plan, const char *name);
/* The same for a call that reads and hands over no bytes: faults of bytes are none there. */
bool fault_reading_fails(const char *name);
/* A stream that reads by read(); NULL: there is none for -1, and errno. */
FILE *fault_stream(int file);

#endif
