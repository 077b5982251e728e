// SPDX-License-Identifier: MIT
#include <array>
#include <span>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

// A cross-section at x: an ellipse of half-axes y and z, lifted by `sag` times the square of the
// place across, which makes a bowl of it.
struct Section {
  double x, half_y, half_z, lift, sag;
};

// Between the given sections, linearly.
Section At(std::span<const Section> sections, double place) {
  const int i = std::min(static_cast<int>(place), static_cast<int>(sections.size()) - 2);
  const double t = place - i;
  const Section &a = sections[i], &b = sections[i + 1];
  const auto mix = [t](double from, double to) { return (1 - t) * from + t * to; };
  return {mix(a.x, b.x), mix(a.half_y, b.half_y), mix(a.half_z, b.half_z), mix(a.lift, b.lift),
          mix(a.sag, b.sag)};
}

// `stations` closed curves of `sides` points through the sections; the first and last section give
// the poles.
Shape Swept(std::span<const Section> sections, int stations, int sides) {
  Shape shape;
  const double spread = static_cast<double>(sections.size() - 1) / (stations + 1);
  for (int s = 1; s <= stations; ++s) {
    const Section section = At(sections, s * spread);
    for (int i = 0; i < sides; ++i) {
      const auto [y, z] = OnCircle(i, sides);
      shape.AddVertex(section.x, section.half_y * y,
                      section.half_z * z + section.lift + section.sag * (y * y));
    }
  }
  const int first = shape.AddVertex(sections.front().x, 0, sections.front().lift);
  const int last = shape.AddVertex(sections.back().x, 0, sections.back().lift);
  const int end = (stations - 1) * sides;
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    shape.AddTriangle(next, i, first);
    for (int s = 0; s + 1 < stations; ++s) {
      const int at = s * sides;
      shape.AddQuad(at + i, at + next, at + sides + next, at + sides + i);
    }
    shape.AddTriangle(end + i, end + next, last);
  }
  return shape;
}

}  // namespace

Shape Spoon(int stations, int sides) {
  constexpr std::array<Section, 9> kSections = {{{-1.0, 0, 0, 0.3, 0},
                                                 {-0.7, 0.55, 0.06, -0.05, 0.3},
                                                 {0.0, 0.8, 0.06, -0.25, 0.5},
                                                 {0.7, 0.6, 0.06, -0.1, 0.35},
                                                 {1.2, 0.2, 0.07, 0.3, 0.05},
                                                 {1.8, 0.12, 0.08, 0.45, 0.0},
                                                 {3.2, 0.15, 0.08, 0.4, 0.0},
                                                 {4.4, 0.25, 0.07, 0.15, 0.02},
                                                 {4.7, 0, 0, 0.05, 0}}};
  return Swept(kSections, stations, sides);
}

Shape Fish(int stations, int sides) {
  constexpr std::array<Section, 9> kSections = {{{-2.0, 0, 0, 0, 0},
                                                 {-1.6, 0.3, 0.45, 0, 0},
                                                 {-0.8, 0.5, 0.85, 0.05, 0},
                                                 {0.2, 0.45, 0.8, 0.05, 0},
                                                 {1.2, 0.25, 0.4, 0, 0},
                                                 {1.8, 0.1, 0.15, 0, 0},
                                                 {2.3, 0.07, 0.5, 0, 0},
                                                 {2.8, 0.05, 1.0, 0, 0},
                                                 {2.5, 0, 0, 0, 0}}};
  return Swept(kSections, stations, sides);
}

}  // namespace touchstone
