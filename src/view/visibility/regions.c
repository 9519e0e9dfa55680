/* regions.c: the public call for visible regions. */
#include "base/floats.h"
#include "geom/selftest.h"
#include "support/fail.h"
#include "view/visibility/region.h"

typedef struct region_rings {
    view_region region;
    ARRAY(double) coords;
    ARRAY(size_t) starts;
} region_rings;

froe_status froe_visibility_regions(const froe_visibility *v, uint32_t first, uint32_t count, froe_region_fn *fn,
                                    void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    region_rings g = {.coords = {0}};
    bool go_on = true;
    if (!v || !fn) return support_fail_null(diag, __func__);
    view_sightlines sights;
    if (view_sightlines_fork(&v->sights, &sights)) return support_fail_memory(diag);
    bool ok = true;
    for (uint32_t p = first; ok && go_on && p < v->surface->patch_count && p - first < count; p++) {
        if (v->patch_starts[p] == v->patch_starts[p + 1]) continue;
        const view_region *r = &g.region;
        g.coords.count = g.starts.count = 0;
        ok = !view_region_make(&g.region, v, &sights, p) && array_reserve(&v->alloc, &g.coords, 3 * r->corners.count) &&
             array_reserve(&v->alloc, &g.starts, r->starts.count);
        if (!ok) break;
        const geom_plane plane = view_plane_of(&v->sights, p);
        for (size_t i = 0; i < r->starts.count; i++) g.starts.data[i] = r->starts.data[i];
        for (size_t i = 0; i < r->corners.count; i++) {
            double ray[3];
            view_ray_at(v, r->corners.data[i], ray);
            view_point_on(&v->sights, &plane, ray, g.coords.data + 3 * i);
        }
        go_on = base_callback(fn(user, p, g.coords.data, g.starts.data, r->starts.count - 1));
    }
    view_region_free(&v->alloc, &g.region);
    array_free(&v->alloc, &g.coords);
    array_free(&v->alloc, &g.starts);
    view_sightlines_close(&sights);
    return ok ? FROE_OK : support_fail_memory(diag);
}
