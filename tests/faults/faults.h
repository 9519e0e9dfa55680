/* faults.h: the system calls that write files, which fail on demand.
 *
 * The linker leads every call of the functions in cmake/FroeTests.cmake to faults.c (--wrap), in a test or in the
 * program. Calls are counted from 1 where they belong to an output: a file or folder opened for it. The program reads
 * FROE_FAULT, "NUMBER KIND", and FROE_FAULT_LOG, a descriptor that gets a line for each call.
 *
 * memory.c does the same for calls that give memory, FROE_FAULT_MEMORY, and for those that tell of progress,
 * FROE_FAULT_STEPS. FROE_FAULT_COUNTS is a descriptor that gets their numbers in the end. */
#ifndef FROE_TESTS_FAULTS_H
#define FROE_TESTS_FAULTS_H

typedef enum fault_kind {
    FAULT_NONE,
    FAULT_EIO,       /* this call fails: Input/output error */
    FAULT_ENOSPC,    /* No space left on device */
    FAULT_EINTR,     /* Interrupted system call */
    FAULT_SHORT,     /* write() writes one byte only */
    FAULT_FOREVER,   /* this call and all after it: Input/output error */
    FAULT_KILL,      /* kill -9 instead of this call */
    FAULT_INTERRUPT, /* Ctrl-C, then the call */
    FAULT_TERMINATE, /* kill, then the call */
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

extern fault_plan faults;

#endif
