// boost_boxes.cpp: Boost.Geometry's R-tree of boxes, packed: bulk loaded from a range.
#include "boxes.h"
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <vector>

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

template <int dim> struct packed {
    using point = bg::model::point<double, dim, bg::cs::cartesian>;
    using box = bg::model::box<point>;
    using value = std::pair<box, uint32_t>;
    using tree = bgi::rtree<value, bgi::rstar<16>>;

    static box make(const double *lo, const double *hi) {
        box b;
        bg::set<bg::min_corner, 0>(b, lo[0]), bg::set<bg::max_corner, 0>(b, hi[0]);
        bg::set<bg::min_corner, 1>(b, lo[1]), bg::set<bg::max_corner, 1>(b, hi[1]);
        if constexpr (dim > 2) bg::set<bg::min_corner, 2>(b, lo[2]), bg::set<bg::max_corner, 2>(b, hi[2]);
        return b;
    }
    static void *build(size_t n, const double *lo, const double *hi) {
        std::vector<value> values;
        values.reserve(n);
        for (size_t i = 0; i < n; i++) values.emplace_back(make(lo + dim * i, hi + dim * i), uint32_t(i));
        return new tree(values.begin(), values.end());
    }
    static size_t window(const void *index, const double *lo, const double *hi, uint32_t *out) {
        size_t count = 0;
        auto add = [&](const value &v) { out[count++] = v.second; };
        static_cast<const tree *>(index)->query(bgi::intersects(make(lo, hi)),
                                                boost::make_function_output_iterator(add));
        return count;
    }
};

extern "C" void *peer_boxes_build(int dim, size_t n, const double *lo, const double *hi) {
    return dim == 2 ? packed<2>::build(n, lo, hi) : packed<3>::build(n, lo, hi);
}

extern "C" void peer_boxes_free(int dim, void *index) {
    if (dim == 2)
        delete static_cast<packed<2>::tree *>(index);
    else
        delete static_cast<packed<3>::tree *>(index);
}

extern "C" size_t peer_boxes_window(int dim, void *index, const double *lo, const double *hi, uint32_t *out) {
    return dim == 2 ? packed<2>::window(index, lo, hi, out) : packed<3>::window(index, lo, hi, out);
}
