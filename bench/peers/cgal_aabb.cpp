// cgal_aabb.cpp: CGAL's AABB tree of triangles, in doubles.
#include "space.h"
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <vector>

using kernel = CGAL::Simple_cartesian<double>;
using triangles = std::vector<kernel::Triangle_3>;
using primitive = CGAL::AABB_triangle_primitive<kernel, triangles::const_iterator>;
using tree = CGAL::AABB_tree<CGAL::AABB_traits<kernel, primitive>>;

struct index3 {
    triangles t;
    tree a;
};

static kernel::Point_3 point(const double x[3]) {
    return {x[0], x[1], x[2]};
}

static void *build(const peer_triangle *t, size_t n) {
    auto *x = new index3;
    x->t.reserve(n);
    for (size_t i = 0; i < n; i++) x->t.emplace_back(point(t[i].p[0]), point(t[i].p[1]), point(t[i].p[2]));
    x->a.insert(x->t.begin(), x->t.end());
    x->a.build();
    return x;
}

static void drop(void *index) {
    delete static_cast<index3 *>(index);
}

static kernel::Ray_3 ray_of(const double o[3], const double d[3]) {
    return {point(o), kernel::Vector_3(d[0], d[1], d[2])};
}

static double ray(void *index, const double o[3], const double d[3]) {
    auto hit = static_cast<index3 *>(index)->a.first_intersection(ray_of(o, d));
    if (!hit) return INFINITY;
    const auto *p = boost::get<kernel::Point_3>(&hit->first);
    if (!p) return INFINITY;
    return ((p->x() - o[0]) * d[0] + (p->y() - o[1]) * d[1] + (p->z() - o[2]) * d[2]) /
           (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

static bool any(void *index, const double o[3], const double d[3]) {
    return static_cast<index3 *>(index)->a.do_intersect(ray_of(o, d));
}

static size_t window(void *index, const double lo[3], const double hi[3], uint32_t *out) {
    auto *x = static_cast<index3 *>(index);
    static thread_local std::vector<tree::Primitive_id> found;
    found.clear();
    x->a.all_intersected_primitives(kernel::Iso_cuboid_3(point(lo), point(hi)), std::back_inserter(found));
    for (size_t i = 0; i < found.size(); i++) out[i] = uint32_t(found[i] - x->t.cbegin());
    return found.size();
}

/* Its tree of points, made once by the first call, gives it a good bound to begin with. */
static double near(void *index, const double p[3]) {
    return std::sqrt(static_cast<index3 *>(index)->a.squared_distance(point(p)));
}

extern "C" const space_peer peer_cgal_aabb = {"CGAL", build, drop, nullptr, ray, any, window, near};
