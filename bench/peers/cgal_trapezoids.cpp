// cgal_trapezoids.cpp: point location by CGAL's randomised trapezoidal map over an arrangement of disjoint segments.
#include "index.h"
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arr_trapezoid_ric_point_location.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <memory>
#include <vector>

using kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using traits = CGAL::Arr_segment_traits_2<kernel>;
using arrangement = CGAL::Arrangement_2<traits>;
using location = CGAL::Arr_trapezoid_ric_point_location<arrangement>;

struct index2 {
    arrangement map;
    std::unique_ptr<location> where;
};

static void *build(const peer_segment *s, size_t n) {
    std::vector<traits::X_monotone_curve_2> curves;
    curves.reserve(n);
    for (size_t i = 0; i < n; i++)
        curves.emplace_back(kernel::Point_2(s[i].ax, s[i].ay), kernel::Point_2(s[i].bx, s[i].by));
    auto *x = new index2;
    CGAL::insert_non_intersecting_curves(x->map, curves.begin(), curves.end());
    x->where = std::make_unique<location>(x->map);
    return x;
}

static void drop(void *index) {
    delete static_cast<index2 *>(index);
}

// The number of the face, as its address; what lies on an edge or a corner is told apart from faces.
static int64_t locate(void *index, double px, double py) {
    const auto found = static_cast<index2 *>(index)->where->locate(kernel::Point_2(px, py));
    const auto *face = boost::get<arrangement::Face_const_handle>(&found);
    return face ? int64_t(reinterpret_cast<intptr_t>(&**face)) : -1;
}

extern "C" const peer peer_trapezoids = {"CGAL trapezoids", build, drop, nullptr, nullptr, nullptr, locate, nullptr};
