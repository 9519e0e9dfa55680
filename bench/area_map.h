/* area_map.h: a scene of areas in the form that other libraries read: rings of polygons, and every border once. */
#ifndef FROE_BENCH_AREA_MAP_H
#define FROE_BENCH_AREA_MAP_H
#include "peers/areas.h"
#include "peers/index.h"
#include <froe/query.h>

typedef struct area_map {
    peer_map rings;        /**< for GEOS */
    peer_segment *borders; /**< for CGAL: each once, none of no length */
    size_t border_count;
} area_map;

/** Of a scene whose segments follow the rings of its groups, as readers leave them. */
area_map area_map_of(const froe_scene *scene);
void area_map_free(area_map *map);
/** Do borders meet in their corners only? */
bool area_map_is_plain(const area_map *map);
#endif
