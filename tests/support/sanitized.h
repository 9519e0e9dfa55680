/* sanitized.h: is this a build with sanitizers? They look for other things than wrong answers, and slow small blocks
 * and fresh memory down many times over, so that some tests take a smaller sample there. The sample of ordinary builds
 * holds it. */
#ifndef FROE_TESTS_SUPPORT_SANITIZED_H
#define FROE_TESTS_SUPPORT_SANITIZED_H

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { SANITIZED = 1 };
#else
enum { SANITIZED = 0 };
#endif

/* One of so many cases is tried there, all elsewhere. */
#define SANITIZED_SHARE(share) (SANITIZED ? (share) : 1)
#endif
