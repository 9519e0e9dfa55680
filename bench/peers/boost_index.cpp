// boost_index.cpp: Boost.Geometry's R-tree, packed, of the bounding boxes of segments.
#include "index.h"
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <vector>

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using point = bg::model::point<double, 2, bg::cs::cartesian>;
using box = bg::model::box<point>;
using value = std::pair<box, uint32_t>;
using tree = bgi::rtree<value, bgi::rstar<16>>;

struct index2 {
    const peer_segment *s;
    tree t;
};

static box box_of(const peer_segment &s) {
    return box(point(s.ax, std::min(s.ay, s.by)), point(s.bx, std::max(s.ay, s.by)));
}

static void *build(const peer_segment *s, size_t n) {
    std::vector<value> values;
    values.reserve(n);
    for (size_t i = 0; i < n; i++) values.emplace_back(box_of(s[i]), uint32_t(i));
    return new index2{s, tree(values.begin(), values.end())};
}

static void drop(void *index) {
    delete static_cast<index2 *>(index);
}

static size_t window(void *index, const double lo[2], const double hi[2], uint32_t *out) {
    const auto *x = static_cast<index2 *>(index);
    size_t count = 0;
    auto add = [&](const value &v) {
        if (peer_meets_window(x->s + v.second, lo, hi)) out[count++] = v.second;
    };
    x->t.query(bgi::intersects(box(point(lo[0], lo[1]), point(hi[0], hi[1]))),
               boost::make_function_output_iterator(add));
    return count;
}

// Slabs of the column above the point, each twice as high as the one before, until one holds the first hit.
static int64_t above(void *index, double x, double y) {
    const auto *ix = static_cast<index2 *>(index);
    const box all = ix->t.bounds();
    double top = bg::get<bg::max_corner, 1>(all), low = y, best_y = 1e300, at;
    double step = std::sqrt((bg::get<bg::max_corner, 0>(all) - bg::get<bg::min_corner, 0>(all)) *
                            (top - bg::get<bg::min_corner, 1>(all)) / double(ix->t.size() + 1));
    int64_t best = -1;
    for (;; step *= 2) {
        double high = low + step;
        auto look = [&](const value &v) {
            if (peer_above(ix->s + v.second, x, y, &at) && at < best_y) best_y = at, best = v.second;
        };
        ix->t.query(bgi::intersects(box(point(x, low), point(x, high))), boost::make_function_output_iterator(look));
        if ((best >= 0 && best_y <= high) || high >= top) return best;
        low = high;
    }
}

static size_t pairs(const peer_segment *s, size_t n) {
    auto *x = static_cast<index2 *>(build(s, n));
    size_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        auto add = [&](const value &v) { count += v.second > i && peer_meet(s + i, s + v.second); };
        x->t.query(bgi::intersects(box_of(s[i])), boost::make_function_output_iterator(add));
    }
    drop(x);
    return count;
}

extern "C" const peer peer_boost = {"Boost", build, drop, nullptr, window, above, nullptr, pairs};
