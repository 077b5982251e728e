// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

// Makes a shape of about so many faces.
using Maker = std::function<Shape(int)>;

struct Entry {
  std::string name;
  int face_count;  // unless another is asked for
  Maker make;
};

// 2 k^2 `ratio` = count: the smaller of two numbers of steps.
int Steps(int face_count, double ratio) {
  return std::max(3, static_cast<int>(std::lround(std::sqrt(face_count / (2.0 * ratio)))));
}

Shape TorusOf(int face_count, double major, double minor) {
  const int tube = Steps(face_count, 1.6);
  return Torus(std::max(3, face_count / (2 * tube)), tube, major, minor);
}

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> kEntries = {
      {"box", 12,
       [](int) {
         return Box({-1, -1, -1}, {1, 1, 1});
       }},
      {"l", 36, [](int) { return LShape(); }},
      {"u", 60, [](int) { return UShape(); }},
      {"axes", 36, [](int) { return Axes(4); }},
      {"slot", 0, [](int) { return Slot(); }},
      {"pocket", 0, [](int) { return Pocket(); }},
      {"key", 12, [](int) { return Key(); }},
      {"hollow", 24, [](int) { return HollowBox(); }},
      {"cone", 1000, [](int n) { return Cone(std::max(3, n / 2), 1.5, 4.0); }},
      {"torus", 2000, [](int n) { return TorusOf(n, 2.0, 0.75); }},
      {"tori", 1000,
       [](int n) {
         const int tube = Steps(n / 2, 1.6);
         return InterlockedTori(std::max(3, n / (4 * tube)), tube);
       }},
      {"cup", 1008, [](int n) { return Cup(std::max(3, n / 16)); }},
      {"spoon", 1300,
       [](int n) {
         const int sides = Steps(n, 2.0);
         return Spoon(std::max(8, n / (2 * sides) - 1), sides);
       }},
      {"fish", 950,
       [](int n) {
         const int sides = Steps(n, 1.4);
         return Fish(std::max(8, n / (2 * sides) - 1), sides);
       }},
      {"gear", 320, [](int n) { return Gear(std::max(6, n / 16)); }},
      {"star", 20, [](int n) { return Star(std::max(3, n / 4)); }},
      {"dimpled", 0, [](int n) { return Dimpled(n == 0 ? 6 : std::max(3, (n - 14) / 2)); }},
      {"spiked", 0, [](int n) { return Spiked(n == 0 ? 6 : std::max(3, (n - 14) / 2)); }}};
  return kEntries;
}

}  // namespace

Shape NamedShape(const std::string& name, int face_count) {
  for (const Entry& entry : Entries()) {
    if (entry.name != name) continue;
    const int wanted = face_count > 0 ? face_count : entry.face_count;
    return Refined(entry.make(wanted), wanted);
  }
  return {};
}

std::span<const std::string> ShapeNames() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Entry& entry : Entries()) names.push_back(entry.name);
    return names;
  }();
  return kNames;
}

}  // namespace touchstone
