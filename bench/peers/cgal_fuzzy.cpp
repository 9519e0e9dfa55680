// cgal_fuzzy.cpp: CGAL's kd-tree, asked with Fuzzy_sphere, in doubles.
#include "peer.h"
#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Kd_tree.h>
#include <CGAL/Search_traits_2.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <boost/iterator/function_output_iterator.hpp>
#include <utility>
#include <vector>

using kernel = CGAL::Simple_cartesian<double>;

template <class Point, class Traits, int dim> struct index_of {
    using value = std::pair<Point, uint32_t>;
    using traits = CGAL::Search_traits_adapter<value, CGAL::First_of_pair_property_map<value>, Traits>;
    // The fastest of its kinds here: bounds in the nodes, coordinates beside each other.
    using tree = CGAL::Kd_tree<traits, CGAL::Sliding_midpoint<traits>, CGAL::Tag_true, CGAL::Tag_true>;
    using sphere = CGAL::Fuzzy_sphere<traits>;

    static Point point(const double *x) {
        if constexpr (dim == 2)
            return Point(x[0], x[1]);
        else
            return Point(x[0], x[1], x[2]);
    }
    static void *build(const peer_data *data, const peer *) {
        std::vector<value> values;
        values.reserve(data->count);
        for (size_t i = 0; i < data->count; i++) values.emplace_back(point(data->coords + dim * i), uint32_t(i));
        auto *t = new tree(values.begin(), values.end());
        t->build();
        return t;
    }
    static void drop(void *index) {
        delete static_cast<tree *>(index);
    }
    struct put {
        peer_answers *out;
        void operator()(const value &v) const {
            peer_put(out, v.second);
        }
    };
    // Everything nearer than radius - fuzz is found, and nothing further away than radius + fuzz.
    static void answer(void *index, const peer_questions *q, peer_answers *out) {
        auto *t = static_cast<tree *>(index);
        const double *x = q->numbers;
        for (size_t i = 0; i < q->count; i++, x += q->width) {
            const double fuzz = q->work == PEER_FUZZY ? x[dim + 1] / 2 : 0;
            t->search(boost::make_function_output_iterator(put{out}), sphere(point(x), x[dim] + fuzz, fuzz));
            out->ends[i] = out->used;
        }
    }
    static bool serves(const peer_data *data, peer_work work) {
        return data->kind == PEER_POINTS && data->dim == dim && (work == PEER_BALL || work == PEER_FUZZY);
    }
};

using plane = index_of<kernel::Point_2, CGAL::Search_traits_2<kernel>, 2>;
using space = index_of<kernel::Point_3, CGAL::Search_traits_3<kernel>, 3>;

static const peer all[] = {
    {"CGAL", "its kd-tree with Fuzzy_sphere", 0, false, plane::serves, plane::build, plane::drop, plane::answer,
     nullptr, nullptr, nullptr},
    {"CGAL", "its kd-tree with Fuzzy_sphere", 0, false, space::serves, space::build, space::drop, space::answer,
     nullptr, nullptr, nullptr},
};

const peer *peer_at(size_t i) {
    return i < 2 ? all + i : nullptr;
}
