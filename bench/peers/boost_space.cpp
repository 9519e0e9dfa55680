// boost_space.cpp: Boost.Geometry's R-tree, packed, of the bounding boxes of triangles.
#include "space.h"
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <vector>

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using point = bg::model::point<double, 3, bg::cs::cartesian>;
using box = bg::model::box<point>;
using value = std::pair<box, uint32_t>;
using tree = bgi::rtree<value, bgi::rstar<16>>;

struct index3 {
    const peer_triangle *t;
    tree r;
};

static void *build(const peer_triangle *t, size_t n) {
    std::vector<value> values;
    values.reserve(n);
    for (size_t i = 0; i < n; i++) {
        double lo[3], hi[3];
        peer_bounds(t + i, lo, hi);
        values.emplace_back(box(point(lo[0], lo[1], lo[2]), point(hi[0], hi[1], hi[2])), uint32_t(i));
    }
    return new index3{t, tree(values.begin(), values.end())};
}

static void drop(void *index) {
    delete static_cast<index3 *>(index);
}

static size_t window(void *index, const double lo[3], const double hi[3], uint32_t *out) {
    const auto *x = static_cast<index3 *>(index);
    size_t count = 0;
    auto add = [&](const value &v) {
        if (peer_meets_box(x->t + v.second, lo, hi)) out[count++] = v.second;
    };
    x->r.query(bgi::intersects(box(point(lo[0], lo[1], lo[2]), point(hi[0], hi[1], hi[2]))),
               boost::make_function_output_iterator(add));
    return count;
}

extern "C" const space_peer peer_boost_space = {"Boost", build, drop, nullptr, nullptr, nullptr, window, nullptr};
