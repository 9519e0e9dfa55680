// boost_rtree.cpp: Boost.Geometry's R-tree, packed (STR) by its range constructor, as an index of segments.
#include "peers.h"
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <vector>

namespace bg = boost::geometry;
using point = bg::model::point<double, 2, bg::cs::cartesian>;
using box = bg::model::box<point>;
using value = std::pair<box, unsigned>;

size_t peer_boost_rtree(const double *s, size_t n) {
    std::vector<value> values;
    values.reserve(n);
    for (size_t i = 0; i < n; i++, s += 4)
        values.emplace_back(box(point(std::min(s[0], s[2]), std::min(s[1], s[3])),
                                point(std::max(s[0], s[2]), std::max(s[1], s[3]))),
                            unsigned(i));
    bg::index::rtree<value, bg::index::rstar<16>> tree(values.begin(), values.end());
    return tree.size();
}
