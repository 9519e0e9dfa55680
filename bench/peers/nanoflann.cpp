// nanoflann.cpp: kd-trees of points, of a header that many use for nearest neighbours; ten points in a leaf, its default.
#include "peer.h"
#include <cmath>
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
    std::vector<uint32_t> found_ids;
    std::vector<std::pair<uint32_t, double>> found;

    index_of(const double *x, size_t n) : points{x, n}, t(dim, points) {
    }
    static void *build(const peer_data *data, const peer *) {
        return new index_of(data->coords, data->count);
    }
    static void drop(void *index) {
        delete static_cast<index_of *>(index);
    }
    void near(const double *x, size_t k, double *distances) {
        found_ids.resize(k);
        const size_t count = t.knnSearch(x, k, found_ids.data(), distances);
        for (size_t i = 0; i < count; i++) distances[i] = std::sqrt(distances[i]);
    }
    void ball(const double *centre, double radius, peer_answers *out) {
        nanoflann::SearchParams unsorted;
        unsorted.sorted = false;
        const size_t count = t.radiusSearch(centre, radius * radius, found, unsorted);
        for (size_t k = 0; k < count; k++) peer_put(out, found[k].first);
    }
    static void answer(void *index, const peer_questions *q, peer_answers *out) {
        auto *x = static_cast<index_of *>(index);
        for (size_t i = 0; i < q->count; i++) {
            const double *at = q->numbers + i * q->width;
            if (q->work != PEER_BALL)
                x->near(at, q->k, out->values + i * q->k);
            else
                x->ball(at, at[dim], out), out->ends[i] = out->used;
        }
    }
    static bool serves(const peer_data *data, peer_work work) {
        return data->kind == PEER_POINTS && data->dim == dim &&
               (work == PEER_NEAREST || work == PEER_NEAREST_K || work == PEER_BALL);
    }
};
using plane = index_of<2>;
using space = index_of<3>;
const peer all[] = {
    {"nanoflann", "kd-trees with ten points in a leaf, its default", 0, false, plane::serves, plane::build, plane::drop,
     plane::answer, nullptr, nullptr, nullptr},
    {"nanoflann", "kd-trees with ten points in a leaf, its default", 0, false, space::serves, space::build, space::drop,
     space::answer, nullptr, nullptr, nullptr},
};
} // namespace

const peer *peer_at(size_t i) {
    return i < 2 ? all + i : nullptr;
}
