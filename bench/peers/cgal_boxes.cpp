// cgal_boxes.cpp: CGAL::box_self_intersection_d, all pairs of boxes that meet; the test of segments is ours.
#include "index.h"
#include <CGAL/box_intersection_d.h>
#include <vector>

using box = CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const peer_segment *>;

static size_t pairs(const peer_segment *s, size_t n) {
    std::vector<box> boxes;
    boxes.reserve(n);
    for (size_t i = 0; i < n; i++) {
        double lo[2] = {s[i].ax, std::min(s[i].ay, s[i].by)}, hi[2] = {s[i].bx, std::max(s[i].ay, s[i].by)};
        boxes.emplace_back(lo, hi, s + i);
    }
    size_t count = 0;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                  [&](const box &a, const box &b) { count += peer_meet(a.handle(), b.handle()); });
    return count;
}

extern "C" const peer peer_boxes = {"CGAL boxes", nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, pairs};
