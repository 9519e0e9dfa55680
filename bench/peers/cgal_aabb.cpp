// cgal_aabb.cpp: CGAL's AABB tree of triangles, in doubles.
#include "peer.h"
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <boost/iterator/function_output_iterator.hpp>
#include <cmath>
#include <vector>

using kernel = CGAL::Simple_cartesian<double>;
using triangles = std::vector<kernel::Triangle_3>;
using primitive = CGAL::AABB_triangle_primitive<kernel, triangles::const_iterator>;
using tree = CGAL::AABB_tree<CGAL::AABB_traits<kernel, primitive>>;

struct index3 {
    triangles t;
    tree a;
};

static kernel::Point_3 point(const double *x) {
    return {x[0], x[1], x[2]};
}

static void *build(const peer_data *data, const peer *) {
    auto *x = new index3;
    x->t.reserve(data->count);
    for (size_t i = 0; i < data->count; i++) {
        const double *t = data->coords + 9 * i;
        x->t.emplace_back(point(t), point(t + 3), point(t + 6));
    }
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

static void window(void *index, const double *lo, const double *hi, peer_answers *out) {
    auto *x = static_cast<index3 *>(index);
    auto add = [&](tree::Primitive_id found) { peer_put(out, uint32_t(found - x->t.cbegin())); };
    x->a.all_intersected_primitives(kernel::Iso_cuboid_3(point(lo), point(hi)),
                                    boost::make_function_output_iterator(add));
}

/* Its tree of points, made once by the first call, gives it a good bound to begin with. */
static double near(void *index, const double p[3]) {
    return std::sqrt(static_cast<index3 *>(index)->a.squared_distance(point(p)));
}

static void answer(void *index, const peer_questions *q, peer_answers *out) {
    const double *x = q->numbers;
    for (size_t i = 0; i < q->count; i++, x += q->width)
        if (q->work == PEER_WINDOW)
            window(index, x, x + 3, out), out->ends[i] = out->used;
        else
            out->values[i] = q->work == PEER_NEAREST     ? near(index, x)
                             : q->work == PEER_FIRST_HIT ? ray(index, x, q->directions + 3 * i)
                                                         : any(index, x, q->directions + 3 * i);
}

static bool serves(const peer_data *data, peer_work work) {
    return data->kind == PEER_TRIANGLES &&
           (work == PEER_WINDOW || work == PEER_NEAREST || work == PEER_FIRST_HIT || work == PEER_ANY_HIT);
}

static const peer aabb = {"CGAL", "its AABB tree, in doubles", 0, false, serves, build, drop, answer, nullptr, nullptr,
                          nullptr};

const peer *peer_at(size_t i) {
    return i ? nullptr : &aabb;
}
