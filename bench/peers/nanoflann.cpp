// nanoflann.cpp: kd-trees of points, of a header that many use for nearest neighbours; ten points in a leaf, its default.
#include "points.h"
#include <nanoflann.hpp>
#include <utility>
#include <vector>

namespace {
template <int dim> struct index_of {
    struct cloud {
        const double *x;
        size_t n;
        size_t kdtree_get_point_count() const {
            return n;
        }
        double kdtree_get_pt(size_t i, size_t axis) const {
            return x[dim * i + axis];
        }
        template <class Box> bool kdtree_get_bbox(Box &) const {
            return false;
        }
    };
    using tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, cloud>, cloud, dim, uint32_t>;

    cloud points;
    tree t;
    std::vector<double> squares;
    std::vector<std::pair<uint32_t, double>> found;

    index_of(const double *x, size_t n) : points{x, n}, t(dim, points) {
    }
    static void *build(const double *points, size_t n) {
        return new index_of(points, n);
    }
    static void drop(void *index) {
        delete static_cast<index_of *>(index);
    }
    static size_t near(void *index, const double *x, size_t k, uint32_t *out) {
        auto *i = static_cast<index_of *>(index);
        i->squares.resize(k);
        return i->t.knnSearch(x, k, out, i->squares.data());
    }
    static size_t ball(void *index, const double *centre, double radius, uint32_t *out) {
        auto *i = static_cast<index_of *>(index);
        nanoflann::SearchParams unsorted;
        unsorted.sorted = false;
        const size_t count = i->t.radiusSearch(centre, radius * radius, i->found, unsorted);
        for (size_t k = 0; k < count; k++) out[k] = i->found[k].first;
        return count;
    }
};
using plane = index_of<2>;
using space = index_of<3>;
} // namespace

extern "C" const points_peer peer_nanoflann_2 = {"nanoflann", plane::build, plane::drop, plane::near, plane::ball};
extern "C" const points_peer peer_nanoflann_3 = {"nanoflann", space::build, space::drop, space::near, space::ball};
