// SPDX-License-Identifier: GPL-3.0-or-later
//
// Along random lines M° begins and ends where the surface says.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "touchstone/exact/judge/sum_checks.h"

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;

// SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // In [0, 1).
  double Next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

struct Line {
  RationalPoint origin, direction;
  Vector3d near, along;  // the same in doubles, in units of the size; along of unit length
};

struct Crossing {
  mpq_class at;  // origin + at * direction
  bool enters;
  int triangle;
};

class LineCheck {
 public:
  explicit LineCheck(const SumContext& context)
      : context_(context),
        boundary_(context.boundary),
        random_(context.options.seed),
        unit_(1.0 / context.pair.size()) {
    low_ = high_ = boundary_.vertices[boundary_.triangles[0][0]];
    for (const auto& t : boundary_.triangles) {
      Vector3d middle = Vector3d::Zero();
      for (const int v : t) {
        low_ = low_.cwiseMin(boundary_.vertices[v]);
        high_ = high_.cwiseMax(boundary_.vertices[v]);
        middle += unit_ * boundary_.vertices[v] / 3.0;
      }
      double radius = 0.0;
      for (const int v : t) {
        radius = std::max(radius, (unit_ * boundary_.vertices[v] - middle).norm());
      }
      balls_.emplace_back(middle, radius);
    }
  }

  void Run() {
    // A line through an edge or a vertex of the surface is replaced.
    for (int line = 0, attempt = 0; line < context_.options.lines && attempt < 100; ++attempt) {
      const Line along = RandomLine();
      const auto crossings = CrossingsOf(along);
      if (!crossings) continue;
      CheckLine(along, *crossings);
      ++line;
    }
  }

 private:
  Vector3d RandomPoint() {
    Vector3d x;
    for (int i = 0; i < 3; ++i) x[i] = low_[i] + random_.Next() * (high_[i] - low_[i]);
    return x;
  }

  Line RandomLine() {
    const Vector3d from = RandomPoint(), to = RandomPoint();
    const RationalPoint origin = context_.sum.FromDoubles(from);
    return {origin, context_.sum.FromDoubles(to) - origin, unit_ * from,
            (unit_ * to - unit_ * from).normalized()};
  }

  // In order; nothing if the line meets the border of a triangle, or two triangles in one point.
  std::optional<std::vector<Crossing>> CrossingsOf(const Line& line) const {
    std::vector<Crossing> crossings;
    for (int t = 0; t < std::ssize(boundary_.triangles); ++t) {
      // Lengths are of order one: 1e-9 is far above the rounding of points and of this test.
      const auto& [middle, radius] = balls_[t];
      if ((middle - line.near).cross(line.along).norm() > radius + 1e-9) continue;
      const auto& corners = boundary_.triangles[t];
      int least = 1, greatest = -1;
      for (int k = 0; k < 3; ++k) {
        const RationalPoint u = context_.points[corners[k]] - line.origin;
        const RationalPoint v = context_.points[corners[(k + 1) % 3]] - line.origin;
        const int sign = sgn(Dot(line.direction, Cross(u, v)));
        least = std::min(least, sign);
        greatest = std::max(greatest, sign);
      }
      if (least < 0 && greatest > 0) continue;
      if (least == 0 || greatest == 0) return std::nullopt;
      const SumPlane plane = context_.sum.Plane(boundary_.facets[boundary_.facet_of_triangle[t]]);
      mpq_class rise = 0, height = plane.offset;
      for (int i = 0; i < 3; ++i) {
        rise += plane.normal[i] * line.direction[i];
        height -= plane.normal[i] * line.origin[i];
      }
      crossings.push_back({height / rise, sgn(rise) < 0, t});
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& x, const Crossing& y) { return x.at < y.at; });
    for (std::size_t k = 1; k < crossings.size(); ++k) {
      if (crossings[k - 1].at == crossings[k].at) return std::nullopt;
    }
    return crossings;
  }

  void CheckLine(const Line& line, const std::vector<Crossing>& crossings) {
    for (std::size_t k = 0; k < crossings.size(); ++k) {
      if (crossings[k].enters != (k % 2 == 0)) {
        context_.Add(SumFindingKind::kMissing, "a line meets triangle " +
                                                   std::to_string(crossings[k].triangle) +
                                                   " from the wrong side");
      }
    }
    if (crossings.size() % 2 != 0) {
      context_.Add(SumFindingKind::kMissing, "a line meets the surface an odd number of times");
    }
    for (std::size_t k = 1; k < crossings.size(); ++k) {
      CheckPoint(line, (crossings[k - 1].at + crossings[k].at) / 2, crossings);
    }
    for (int k = 0; k < context_.options.lines; ++k) {
      CheckPoint(line, mpq_class(1.5 * random_.Next() - 0.25), crossings);
    }
  }

  void CheckPoint(const Line& line, const mpq_class& at, const std::vector<Crossing>& crossings) {
    const auto before = std::count_if(crossings.begin(), crossings.end(),
                                      [&](const Crossing& each) { return each.at < at; });
    RationalPoint x;
    for (int i = 0; i < 3; ++i) x[i] = line.origin[i] + at * line.direction[i];
    const Verdict verdict = context_.At(x);
    const Verdict said = before % 2 == 1 ? Verdict::kOverlap : Verdict::kSeparate;
    if (verdict == said) return;
    const RationalPoint place = context_.sum.ToTrue(x);
    context_.Add(SumFindingKind::kMissing,
                 "at " + std::to_string(place[0].get_d()) + ' ' + std::to_string(place[1].get_d()) +
                     ' ' + std::to_string(place[2].get_d()) + " the surface says " +
                     std::string(ToString(said)) + ", is " + std::string(ToString(verdict)));
  }

  const SumContext& context_;
  const SumBoundary& boundary_;
  Random random_;
  const double unit_;
  Vector3d low_, high_;
  std::vector<std::pair<Vector3d, double>> balls_;  // round the triangles
};

}  // namespace

void CheckLines(const SumContext& context) {
  if (context.boundary.triangles.empty()) {
    return context.Add(SumFindingKind::kMissing, "there is no surface at all");
  }
  LineCheck(context).Run();
}

}  // namespace touchstone::exact
