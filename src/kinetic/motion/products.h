/* products.h: sums of products of polynomials (products_body.inc), of balls and of dyadic numbers. */
#ifndef FROE_KINETIC_PRODUCTS_H
#define FROE_KINETIC_PRODUCTS_H
#include "num/poly.h"

#include "num/ball_terms.inc"
#define POLY num_ball_poly
#define MARK (void)arena
#define KEEP(a) (a)
#include "kinetic/motion/products_body.inc"

#include "num/dyadic_terms.inc"
#define POLY num_poly
#define MARK const size_t mark = arena->top
#define KEEP(a) num_dyadic_keep(arena, mark, a)
#include "kinetic/motion/products_body.inc"
#endif
