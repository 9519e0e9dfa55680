// cgal_boxes.cpp: CGAL::box_self_intersection_d, all pairs of boxes that meet; the test of segments is ours.
#include "peer.h"
#include "segment.h"
#include <CGAL/box_intersection_d.h>
#include <vector>

using box = CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const peer_segment *>;

struct boxes_of {
    const peer_data *data;
    std::vector<box> boxes;
};

static void *build(const peer_data *data, const peer *) {
    auto *x = new boxes_of{data, {}};
    const auto *s = reinterpret_cast<const peer_segment *>(data->coords);
    x->boxes.reserve(data->count);
    for (size_t i = 0; i < data->count; i++) {
        double lo[2] = {s[i].ax, std::min(s[i].ay, s[i].by)}, hi[2] = {s[i].bx, std::max(s[i].ay, s[i].by)};
        x->boxes.emplace_back(lo, hi, s + i);
    }
    return x;
}

static void drop(void *index) {
    delete static_cast<boxes_of *>(index);
}

static void answer(void *index, const peer_questions *, peer_answers *out) {
    auto *x = static_cast<boxes_of *>(index);
    const auto *s = reinterpret_cast<const peer_segment *>(x->data->coords);
    double *values = out->values;
    values[0] = values[1] = 0;
    CGAL::box_self_intersection_d(x->boxes.begin(), x->boxes.end(), [&](const box &a, const box &b) {
        if (peer_meet(a.handle(), b.handle())) peer_pair(values, uint32_t(a.handle() - s), uint32_t(b.handle() - s));
    });
}

static bool serves(const peer_data *data, peer_work work) {
    return data->kind == PEER_SEGMENTS && data->dim == 2 && work == PEER_PAIRS;
}

static const peer self_intersection = {
    "CGAL", "box_self_intersection_d", 0, false, serves, build, drop, answer, nullptr, nullptr, nullptr};

const peer *peer_at(size_t i) {
    return i ? nullptr : &self_intersection;
}
