// boost.cpp: Boost.Geometry's R-tree, packed by its range constructor: of bounding boxes, and of segments themselves.
#include "peer.h"
#include "segment.h"
#include "triangle.h"
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <vector>

namespace {
namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

template <int dim> using point_of = bg::model::point<double, dim, bg::cs::cartesian>;

template <int dim> point_of<dim> point(const double *x) {
    point_of<dim> p;
    bg::set<0>(p, x[0]), bg::set<1>(p, x[1]);
    if constexpr (dim > 2) bg::set<2>(p, x[2]);
    return p;
}

/* ---------------------------------------------------------- bounding boxes -- */

template <int dim> struct boxes {
    using box = bg::model::box<point_of<dim>>;
    using value = std::pair<box, uint32_t>;
    using tree = bgi::rtree<value, bgi::rstar<16>>;
    const peer_data *data;
    const peer_segment *s;
    const peer_triangle *t;
    tree r;

    static box box_of(const peer_data *data, size_t i) {
        const int corners = data->kind == PEER_TRIANGLES ? 3 : 2;
        const double *x = data->coords + i * corners * dim;
        double lo[dim], hi[dim];
        for (int k = 0; k < dim; k++) {
            lo[k] = std::min(x[k], x[dim + k]), hi[k] = std::max(x[k], x[dim + k]);
            if (corners > 2) lo[k] = std::min(lo[k], x[2 * dim + k]), hi[k] = std::max(hi[k], x[2 * dim + k]);
        }
        return box(point<dim>(lo), point<dim>(hi));
    }
    static tree packed(const peer_data *data) {
        std::vector<value> values;
        values.reserve(data->count);
        for (size_t i = 0; i < data->count; i++) values.emplace_back(box_of(data, i), uint32_t(i));
        return tree(values.begin(), values.end());
    }
    explicit boxes(const peer_data *d)
        : data(d), s(reinterpret_cast<const peer_segment *>(d->coords)),
          t(reinterpret_cast<const peer_triangle *>(d->coords)), r(packed(d)) {
    }
    void window(const double *lo, const double *hi, peer_answers *out) const {
        auto add = [&](const value &v) {
            if (data->kind == PEER_SEGMENTS ? peer_meets_window(s + v.second, lo, hi)
                                            : data->kind == PEER_BOXES || peer_meets_box(t + v.second, lo, hi))
                peer_put(out, v.second);
        };
        r.query(bgi::intersects(box(point<dim>(lo), point<dim>(hi))), boost::make_function_output_iterator(add));
    }
    // Slabs of the column above the point, each twice as high as the one before, until one holds the first hit.
    double above(double x, double y) const {
        const box all = r.bounds();
        double top = bg::get<bg::max_corner, 1>(all), low = y, best_y = 1e300, at;
        double step = std::sqrt((bg::get<bg::max_corner, 0>(all) - bg::get<bg::min_corner, 0>(all)) *
                                (top - bg::get<bg::min_corner, 1>(all)) / double(r.size() + 1));
        double best = -1;
        for (;; step *= 2) {
            const double high = low + step, from[2] = {x, low}, to[2] = {x, high};
            auto look = [&](const value &v) {
                if (peer_above(s + v.second, x, y, &at) && at < best_y) best_y = at, best = v.second;
            };
            r.query(bgi::intersects(box(point<dim>(from), point<dim>(to))), boost::make_function_output_iterator(look));
            if ((best >= 0 && best_y <= high) || high >= top) return best;
            low = high;
        }
    }
    void pairs(double values[2]) const {
        values[0] = values[1] = 0;
        for (uint32_t i = 0; i < data->count; i++) {
            auto add = [&](const value &v) {
                if (v.second > i && peer_meet(s + i, s + v.second)) peer_pair(values, i, v.second);
            };
            r.query(bgi::intersects(box_of(data, i)), boost::make_function_output_iterator(add));
        }
    }
    void answer(const peer_questions *q, peer_answers *out) const {
        const double *x = q->numbers;
        if (q->work == PEER_PAIRS) return pairs(out->values);
        for (size_t i = 0; i < q->count; i++, x += q->width)
            if (q->work == PEER_WINDOW)
                window(x, x + dim, out), out->ends[i] = out->used;
            else
                out->values[i] = above(x[0], x[1]);
    }
};

bool boxes_serve(const peer_data *data, peer_work work) {
    const bool plane = data->kind == PEER_SEGMENTS && data->dim == 2;
    if (work == PEER_ABOVE || work == PEER_PAIRS) return plane;
    return work == PEER_WINDOW &&
           (plane || data->kind == PEER_TRIANGLES || (data->kind == PEER_BOXES && data->dim < 4));
}

struct any_boxes { // of either dimension
    boxes<2> *plane;
    boxes<3> *space;
};

void *make_boxes(const peer_data *data, const peer *) {
    return data->dim == 2 ? new any_boxes{new boxes<2>(data), nullptr} : new any_boxes{nullptr, new boxes<3>(data)};
}
void free_boxes(void *index) {
    auto *x = static_cast<any_boxes *>(index);
    delete x->plane;
    delete x->space;
    delete x;
}
void ask_boxes(void *index, const peer_questions *q, peer_answers *out) {
    auto *x = static_cast<any_boxes *>(index);
    x->plane ? x->plane->answer(q, out) : x->space->answer(q, out);
}

/* ---------------------------------------------------------------- segments -- */

using segment = bg::model::segment<point_of<2>>;
using named = std::pair<segment, uint32_t>;
using segment_tree = bgi::rtree<named, bgi::rstar<16>>;

bool segments_serve(const peer_data *data, peer_work work) {
    return (work == PEER_NEAREST || work == PEER_NEAREST_K) && data->kind == PEER_SEGMENTS && data->dim == 2;
}
void *make_segments(const peer_data *data, const peer *) {
    std::vector<named> values;
    values.reserve(data->count);
    for (size_t i = 0; i < data->count; i++) {
        const double *x = data->coords + 4 * i;
        values.emplace_back(segment(point<2>(x), point<2>(x + 2)), uint32_t(i));
    }
    return new segment_tree(values.begin(), values.end());
}
void free_segments(void *index) {
    delete static_cast<segment_tree *>(index);
}
void ask_segments(void *index, const peer_questions *q, peer_answers *out) {
    const auto *tree = static_cast<segment_tree *>(index);
    for (size_t i = 0; i < q->count; i++) {
        const auto p = point<2>(q->numbers + 2 * i);
        double *to = out->values + i * q->k;
        size_t found = 0;
        auto add = [&](const named &v) { to[found++] = bg::comparable_distance(p, v.first); };
        tree->query(bgi::nearest(p, unsigned(q->k)), boost::make_function_output_iterator(add));
        std::sort(to, to + found);
        for (size_t j = 0; j < found; j++) to[j] = std::sqrt(to[j]);
    }
}

const peer all[] = {
    {"Boost", "Boost.Geometry's R-tree of bounding boxes, packed", 0, false, boxes_serve, make_boxes, free_boxes,
     ask_boxes, nullptr, nullptr, nullptr},
    {"Boost, segments", "Boost.Geometry's R-tree of segments, packed", 0, false, segments_serve, make_segments,
     free_segments, ask_segments, nullptr, nullptr, nullptr},
};
} // namespace

const peer *peer_at(size_t i) {
    return i < 2 ? all + i : nullptr;
}
