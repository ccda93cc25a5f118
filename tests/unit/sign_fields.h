// Named sign fields for any dimension and box.
#pragma once

#include <string>
#include <vector>

#include "dense_signs.h"

namespace isostar {

template <int D>
struct SignField {
  std::string name;
  typename DenseSigns<D>::Positive positive;
};

/// A hash of coordinates, the same on every machine.
template <int D>
uint64_t scrambled(const Coordinates<D>& v, uint64_t seed) {
  uint64_t h = seed * 0x9E3779B97F4A7C15u + 0x1234567;
  for (int32_t x : v) {
    h = (h ^ static_cast<uint64_t>(x)) * 0xD6E8FEB86659FD93u;
    h ^= h >> 32;
  }
  return h;
}

template <int D>
std::vector<SignField<D>> signFields(const Coordinates<D>& box) {
  int32_t longest = 0;
  Coordinates<D> lone{};
  for (int a = 0; a < D; ++a) {
    longest = std::max(longest, box[a]);
    lone[a] = box[a] / 2 | 1;
  }
  auto ball = [=](const Coordinates<D>& v) {
    double squares = 0;
    for (int a = 0; a < D; ++a) squares += (v[a] - box[a] * 0.5) * (v[a] - box[a] * 0.5);
    return squares < longest * longest * 0.16;
  };
  auto halfSpace = [=](const Coordinates<D>& v) {
    double sum = -longest * 0.6;
    for (int a = 0; a < D; ++a) sum += v[a] * (1 + 0.37 * a);
    return sum > 0;
  };
  auto sum = [](const Coordinates<D>& v) {
    int32_t s = 0;
    for (int32_t x : v) s += x;
    return s;
  };
  return {{"noise", [](const Coordinates<D>& v) { return (scrambled<D>(v, 1) & 1) != 0; }},
          {"sparse noise", [](const Coordinates<D>& v) { return scrambled<D>(v, 2) % 40 == 0; }},
          {"dense noise", [](const Coordinates<D>& v) { return scrambled<D>(v, 3) % 40 != 0; }},
          {"ball", ball},
          {"hollow", [=](const Coordinates<D>& v) { return !ball(v); }},
          {"half space", halfSpace},
          {"first plane", [](const Coordinates<D>& v) { return v[0] == 0; }},
          {"last plane", [=](const Coordinates<D>& v) { return v[D - 1] == box[D - 1]; }},
          {"checkerboard", [=](const Coordinates<D>& v) { return (sum(v) & 1) != 0; }},
          {"lone vertex", [=](const Coordinates<D>& v) { return v == lone; }},
          {"corner", [=](const Coordinates<D>& v) { return v == box; }},
          {"negative", [](const Coordinates<D>&) { return false; }},
          {"positive", [](const Coordinates<D>&) { return true; }}};
}

}  // namespace isostar
