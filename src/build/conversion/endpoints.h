/* endpoints.h: builders that turn a BSP of endpoints into one of segments (build/conversion/convert.h). */
#ifndef FROE_BUILD_CONVERSION_ENDPOINTS_H
#define FROE_BUILD_CONVERSION_ENDPOINTS_H
#include "build/method.h"

/** By which rule the endpoints are partitioned first. */
typedef struct convert_plan {
    const char *method, *settings; /**< a method that serves points of the plane; NULL: by ham-sandwich cuts */
    bool prune;
} convert_plan;

/** Points and segments of the plane. Promises a number of fragments. */
froe_status build_converted(build_job *job, const convert_plan *plan, froe_tree **out);
#endif
