// Shapes that a careless weld tears, joins, fills or removes: they are thin and sampled coarsely.
#pragma once

#include "sampled_shapes.h"

namespace isostar {

inline SampledShape<3> fromDistance(int32_t last, std::function<double(const Vector<3>&)> inside) {
  return SampledShape<3>(cube<3>(last), std::move(inside));
}
inline double distance(const Vector<3>& p, const Vector<3>& q) {
  return std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                   (p[2] - q[2]) * (p[2] - q[2]));
}
inline SampledShape<3> knot() {
  std::vector<Vector<3>> curve;
  for (int i = 0; i < 300; ++i) {
    const double t = i * std::acos(-1.0) / 150;
    curve.push_back({16 + 4.6 * (std::sin(t) + 2 * std::sin(2 * t)),
                     16 + 4.6 * (std::cos(t) - 2 * std::cos(2 * t)), 16 - 7 * std::sin(3 * t)});
  }
  return fromDistance(32, [curve](const Vector<3>& p) {
    double nearest = 100;
    for (const auto& q : curve) nearest = std::min(nearest, distance(p, q));
    return 1.6 - nearest;
  });
}
inline SampledShape<3> nested() {
  return fromDistance(20, [](const Vector<3>& p) {
    return std::sin(std::min(distance(p, {9.7, 10.2, 9.9}), 9.3) * 1.5) + 0.1;
  });
}
/// Two pairs touch where several edges join them, and one pair nearly touches.
inline SampledShape<3> touching() {
  return fromDistance(32, [](const Vector<3>& p) {
    double inside = -100;
    for (const Vector<3>& q : {Vector<3>{8, 8, 8}, {8, 8, 22.3}, {18.6, 16, 8}, {18.4, 21.3, 20}})
      inside = std::max(inside, 6.4 - distance(p, q));
    return inside;
  });
}
inline SampledShape<3> leakyBox() {
  return fromDistance(32, [](const Vector<3>& p) {
    const double shell = 1.1 - std::abs(distance(p, {17, 16, 15}) - 10.3);
    const double hole = std::hypot(p[0] - 17.3, p[1] - 16.2) - 1.3;
    return std::min(shell, hole);
  });
}

}  // namespace isostar
