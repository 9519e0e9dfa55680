// cgal_fuzzy.cpp: CGAL's kd-tree, asked with Fuzzy_sphere, in doubles.
#include "fuzzy.h"
#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Kd_tree.h>
#include <CGAL/Search_traits_2.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <iterator>
#include <utility>
#include <vector>

using kernel = CGAL::Simple_cartesian<double>;

template <class Point, class Traits, int dim> struct index_of {
    using value = std::pair<Point, uint32_t>;
    using traits = CGAL::Search_traits_adapter<value, CGAL::First_of_pair_property_map<value>, Traits>;
    // The fastest of its kinds here: bounds in the nodes, coordinates beside each other.
    using tree = CGAL::Kd_tree<traits, CGAL::Sliding_midpoint<traits>, CGAL::Tag_true, CGAL::Tag_true>;
    using sphere = CGAL::Fuzzy_sphere<traits>;

    struct numbers { // an output iterator that keeps the second of a pair
        using iterator_category = std::output_iterator_tag;
        using value_type = void;
        using difference_type = std::ptrdiff_t;
        using pointer = void;
        using reference = void;
        uint32_t *at;
        numbers &operator*() {
            return *this;
        }
        numbers &operator++() {
            return *this;
        }
        numbers &operator++(int) {
            return *this;
        }
        numbers &operator=(const value &v) {
            *at++ = v.second;
            return *this;
        }
    };

    static Point point(const double *x) {
        if constexpr (dim == 2)
            return Point(x[0], x[1]);
        else
            return Point(x[0], x[1], x[2]);
    }
    static void *build(const double *points, size_t n) {
        std::vector<value> values;
        values.reserve(n);
        for (size_t i = 0; i < n; i++) values.emplace_back(point(points + dim * i), uint32_t(i));
        auto *t = new tree(values.begin(), values.end());
        t->build();
        return t;
    }
    static void drop(void *index) {
        delete static_cast<tree *>(index);
    }
    static size_t ball(void *index, const double *centre, double radius, double fuzz, uint32_t *out) {
        auto *t = static_cast<tree *>(index);
        return size_t(t->search(numbers{out}, sphere(point(centre), radius, fuzz)).at - out);
    }
};

using plane = index_of<kernel::Point_2, CGAL::Search_traits_2<kernel>, 2>;
using space = index_of<kernel::Point_3, CGAL::Search_traits_3<kernel>, 3>;

extern "C" const fuzzy_peer peer_fuzzy_2 = {"Fuzzy_sphere", plane::build, plane::drop, plane::ball};
extern "C" const fuzzy_peer peer_fuzzy_3 = {"Fuzzy_sphere", space::build, space::drop, space::ball};
