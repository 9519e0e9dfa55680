/* reading.h: other programs read a file into arrays. One source each: ogr.c, assimp.c. */
#ifndef FROE_BENCH_READING_H
#define FROE_BENCH_READING_H
#include <stddef.h>

/** Reads all coordinates of a file into an array that it frees again. Returns how many points they are; 0: the program
 * cannot read the file. */
typedef size_t reading_fn(const char *path);

reading_fn reading_by_ogr, reading_by_assimp;
#endif
