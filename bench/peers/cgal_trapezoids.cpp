// cgal_trapezoids.cpp: point location by CGAL's randomised trapezoidal map over an arrangement of segments, exact.
#include "peer.h"
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arr_trapezoid_ric_point_location.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

using kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using traits = CGAL::Arr_segment_traits_2<kernel>;
using dcel = CGAL::Arr_extended_dcel<traits, char, uint32_t, char>; // of halfedges: which segment
using arrangement = CGAL::Arrangement_2<traits, dcel>;
using location = CGAL::Arr_trapezoid_ric_point_location<arrangement>;
using ends = std::array<double, 4>;

struct index2 {
    arrangement map;
    std::unique_ptr<location> where;
};

static ends from_left(const double *x) {
    return x[0] < x[2] || (x[0] == x[2] && x[1] < x[3]) ? ends{x[0], x[1], x[2], x[3]} : ends{x[2], x[3], x[0], x[1]};
}

static ends ends_of(const traits::X_monotone_curve_2 &c) {
    return {CGAL::to_double(c.left().x()), CGAL::to_double(c.left().y()), CGAL::to_double(c.right().x()),
            CGAL::to_double(c.right().y())};
}

// Borders of two areas are there twice.
static void *build(const peer_data *data, const peer *) {
    std::vector<std::pair<ends, uint32_t>> named;
    named.reserve(data->count);
    for (size_t i = 0; i < data->count; i++) named.emplace_back(from_left(data->coords + 4 * i), uint32_t(i));
    std::sort(named.begin(), named.end());
    named.erase(std::unique(named.begin(), named.end(), [](auto &a, auto &b) { return a.first == b.first; }),
                named.end());
    std::vector<traits::X_monotone_curve_2> curves;
    curves.reserve(named.size());
    for (const auto &n : named)
        curves.emplace_back(kernel::Point_2(n.first[0], n.first[1]), kernel::Point_2(n.first[2], n.first[3]));
    auto *x = new index2;
    CGAL::insert_non_intersecting_curves(x->map, curves.begin(), curves.end());
    for (auto h = x->map.halfedges_begin(); h != x->map.halfedges_end(); ++h) {
        const ends e = ends_of(h->curve());
        h->set_data(std::lower_bound(named.begin(), named.end(), std::make_pair(e, uint32_t(0)))->second);
    }
    x->where = std::make_unique<location>(x->map);
    return x;
}

static void drop(void *index) {
    delete static_cast<index2 *>(index);
}

// The number of the face is its address; what lies on a border has -1.
static double area(const location &where, const kernel::Point_2 &p) {
    const auto found = where.locate(p);
    const auto *face = boost::get<arrangement::Face_const_handle>(&found);
    return face && !(*face)->is_unbounded() ? double(reinterpret_cast<intptr_t>(&**face)) : -1;
}

static double above(const location &where, const kernel::Point_2 &p) {
    const auto found = where.ray_shoot_up(p);
    const auto *edge = boost::get<arrangement::Halfedge_const_handle>(&found);
    return edge ? double((*edge)->data()) : -1;
}

static void answer(void *index, const peer_questions *q, peer_answers *out) {
    const auto &where = *static_cast<index2 *>(index)->where;
    for (size_t i = 0; i < q->count; i++) {
        const kernel::Point_2 p(q->numbers[2 * i], q->numbers[2 * i + 1]);
        out->values[i] = q->work == PEER_AREA ? area(where, p) : above(where, p);
    }
}

// It takes four seconds for 10^5 segments.
static bool serves(const peer_data *data, peer_work work) {
    return data->disjoint && data->count <= 100000 &&
           ((data->kind == PEER_TRAPEZOIDS && work == PEER_ABOVE) || (data->kind == PEER_AREAS && work == PEER_AREA));
}

static const peer map = {"CGAL",  "its trapezoidal map (Arr_trapezoid_ric_point_location), exact",
                         0,       true,
                         serves,  build,
                         drop,    answer,
                         nullptr, nullptr,
                         nullptr};

const peer *peer_at(size_t i) {
    return i ? nullptr : &map;
}
