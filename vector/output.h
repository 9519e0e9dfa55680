/* output.h: the bytes of a picture on their way to the function that receives them. */
#ifndef FROE_VECTOR_OUTPUT_H
#define FROE_VECTOR_OUTPUT_H
#include "support/arithmetic.h"
#include <froe/render.h>

typedef struct vector_output {
    froe_write_fn *fn;
    void *user;
    uint64_t count;     /**< bytes so far */
    froe_status status; /**< the first failure, after which nothing is written: FROE_E_IO, FROE_E_MEMORY */
    size_t filled;      /**< of the buffer */
    char buffer[1 << 11];
} vector_output;

void vector_put(vector_output *output, const void *bytes, size_t count);
/** A text as printf makes it, of at most 511 bytes. Fractions come from vector_real(). */
void vector_print(vector_output *output, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** A text within XML. */
void vector_put_escaped(vector_output *output, const char *text);
/** Hands over what is left. Returns the status. */
froe_status vector_flush(vector_output *output);

/** A number with so many significant digits, as %g prints it, with a point in every locale. */
typedef struct vector_digits {
    char text[40];
} vector_digits;
vector_digits vector_real(int digits, double x);
/** A number with 15 digits, or 17 where these do not give the same double again. */
vector_digits vector_exact(double x);
void vector_put_exactly(vector_output *output, double x);
/** A text within a string of JSON. */
void vector_put_json(vector_output *output, const char *text);
#endif
