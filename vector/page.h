/* page.h: the one page of a PDF or EPS file. */
#ifndef FROE_VECTOR_PAGE_H
#define FROE_VECTOR_PAGE_H
#include "output.h"

struct vector_render;

/** What the page shows, in operators of PDF. Notes which opacities /aN, 0 .. 255, are used. */
void vector_put_page(struct vector_render *render, vector_output *output, bool alphas[256]);
/** A length of the page in points. */
vector_digits vector_points(const struct vector_render *render, double length);
#endif
