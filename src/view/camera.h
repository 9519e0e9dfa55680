/* camera.h: coordinates of the camera: (right, up, depth) with depth growing away from the eye.
 *
 * It speaks for camera.c and turntable.c (cameras around a scene). */
#ifndef FROE_VIEW_CAMERA_H
#define FROE_VIEW_CAMERA_H
#include "geom/eye.h"
#include <froe/view.h>

/** A point as the camera sees it: right, up, and distance along the line of view (parallel: any). */
void view_camera_point(const froe_projection *view, const double *point, double out[3]);
/** The same onto the page. REQUIRES, in perspective: out[2] > 0. */
void view_camera_page(const froe_projection *view, const double at[3], double page[2]);
/** A ray of the picture (geom/eye.h) of that camera's eye onto the page. */
void view_camera_ray(const froe_projection *view, const geom_eye *eye, const double ray[3], double page[2]);
/** tan(degrees), 0 <= degrees < 90. */
double view_tan(double degrees);
#endif
