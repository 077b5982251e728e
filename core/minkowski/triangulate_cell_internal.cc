// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/triangulate_cell_internal.h"

#include <algorithm>
#include <utility>

namespace touchstone::internal {
namespace {

using Loop = std::vector<int>;

class Triangulator {
 public:
  Triangulator(SumGeometry* geometry, int plane) : geometry_(*geometry), plane_(plane) {
    axis_ = geometry_.NormalAxis(plane);
    sense_ = geometry_.NormalAlong(plane, axis_);
  }

  std::vector<std::array<int, 3>> Run(std::span<const std::span<const int>> loops) {
    if (loops.size() == 1 && IsConvex(loops[0])) {
      FanOut(loops[0]);
      return std::move(triangles_);
    }
    Loop polygon = WithoutSpikes({loops[0].begin(), loops[0].end()});
    std::vector<Loop> holes;
    for (std::size_t k = 1; k < loops.size(); ++k) {
      Loop hole = WithoutSpikes({loops[k].begin(), loops[k].end()});
      if (hole.size() >= 3) holes.push_back(std::move(hole));
    }
    while (!holes.empty() && JoinAHole(&polygon, &holes)) {
    }
    ClipEars(std::move(polygon));
    return std::move(triangles_);
  }

 private:
  int Turn(int x, int y, int z) { return sense_ * geometry_.Turn(x, y, z, axis_, plane_); }
  static int At(const Loop& loop, std::ptrdiff_t k) {
    const auto n = std::ssize(loop);
    return loop[static_cast<std::size_t>((k % n + n) % n)];
  }

  // Whether it turns left at every corner: the outer border of a cell turns round once.
  bool IsConvex(std::span<const int> loop) {
    const auto n = loop.size();
    for (std::size_t k = 0; k < n; ++k) {
      if (Turn(loop[k], loop[k + 1 < n ? k + 1 : 0], loop[(k + 2) % n]) <= 0) return false;
    }
    return true;
  }

  // The triangles that clipping ears would leave.
  void FanOut(std::span<const int> loop) {
    triangles_.reserve(loop.size() - 2);
    for (std::size_t k = 0; k + 2 < loop.size(); ++k) {
      triangles_.push_back({loop.back(), loop[k], loop[k + 1]});
    }
  }

  // Leaves out pieces that the loop runs along and back at once.
  static Loop WithoutSpikes(Loop loop) {
    bool changed = true;
    while (changed && loop.size() >= 3) {
      changed = false;
      for (std::ptrdiff_t k = 0; k < std::ssize(loop); ++k) {
        if (At(loop, k - 1) != At(loop, k + 1)) continue;
        const auto n = std::ssize(loop);
        const std::ptrdiff_t next = (k + 1) % n;
        loop.erase(loop.begin() + std::max(k, next));
        loop.erase(loop.begin() + std::min(k, next));
        changed = true;
        break;
      }
    }
    if (loop.size() < 3) loop.clear();
    return loop;
  }

  // Whether the way from corner k of a loop to x leads strictly into the side on its left.
  bool IsInCone(const Loop& loop, std::ptrdiff_t k, int x) {
    const int before = At(loop, k - 1), corner = At(loop, k), after = At(loop, k + 1);
    if (x == before || x == after || x == corner) return false;
    if (Turn(before, corner, after) > 0) {
      return Turn(corner, after, x) > 0 && Turn(before, corner, x) > 0;
    }
    // A corner of half a turn or more: not in the outer cone, sides included.
    if (Turn(before, corner, after) == 0 && !IsBetween(before, corner, after)) return true;
    return !(Turn(corner, after, x) <= 0 && Turn(before, corner, x) <= 0);
  }

  // For points in one line: whether y lies between x and z.
  bool IsBetween(int x, int y, int z) {
    for (int axis = 0; axis < 3; ++axis) {
      const int sign = geometry_.Compare(x, y, axis);
      if (sign != 0) return sign == geometry_.Compare(y, z, axis);
    }
    return false;
  }

  // Whether the segment x y meets a side of the loop elsewhere than in x or y.
  bool IsBlocked(int x, int y, const Loop& loop) {
    for (std::ptrdiff_t k = 0; k < std::ssize(loop); ++k) {
      const int a = At(loop, k), b = At(loop, k + 1);
      if (a == x || a == y || b == x || b == y) {
        // The cones clear the shared end; the other end must not lie on the segment.
        const int other = a == x || a == y ? b : a;
        if (other != x && other != y && Turn(x, y, other) == 0 && IsBetween(x, other, y)) {
          return true;
        }
        continue;
      }
      if (Turn(x, y, a) * Turn(x, y, b) <= 0 && Turn(a, b, x) * Turn(a, b, y) <= 0) return true;
    }
    return false;
  }

  // Joins one of the holes to the polygon by a bridge that meets nothing; false if there is none.
  bool JoinAHole(Loop* polygon, std::vector<Loop>* holes) {
    for (std::size_t h = 0; h < holes->size(); ++h) {
      const Loop& hole = (*holes)[h];
      for (std::ptrdiff_t k = 0; k < std::ssize(hole); ++k) {
        for (std::ptrdiff_t l = 0; l < std::ssize(*polygon); ++l) {
          const int x = At(hole, k), y = At(*polygon, l);
          if (x == y) {
            Splice(polygon, l, hole, k, false);
            holes->erase(holes->begin() + static_cast<std::ptrdiff_t>(h));
            return true;
          }
          if (!IsInCone(hole, k, y) || !IsInCone(*polygon, l, x) || IsBlocked(x, y, *polygon) ||
              std::any_of(holes->begin(), holes->end(),
                          [&](const Loop& each) { return IsBlocked(x, y, each); })) {
            continue;
          }
          Splice(polygon, l, hole, k, true);
          holes->erase(holes->begin() + static_cast<std::ptrdiff_t>(h));
          return true;
        }
      }
    }
    return false;
  }

  // Corner l, the hole from corner k round, and back; over a bridge both ends come twice.
  static void Splice(Loop* polygon, std::ptrdiff_t l, const Loop& hole, std::ptrdiff_t k,
                     bool over_bridge) {
    Loop round;
    for (std::ptrdiff_t m = 0; m < std::ssize(hole); ++m) round.push_back(At(hole, k + m));
    if (over_bridge) {
      round.push_back(At(hole, k));
      round.push_back(At(*polygon, l));
      polygon->insert(polygon->begin() + l + 1, round.begin(), round.end());
    } else {
      polygon->insert(polygon->begin() + l, round.begin(), round.end());
    }
  }

  bool IsEar(const Loop& loop, std::ptrdiff_t k) {
    const int a = At(loop, k - 1), b = At(loop, k), c = At(loop, k + 1);
    if (a == c || Turn(a, b, c) <= 0) return false;
    if (loop.size() > 3 && (!IsInCone(loop, k - 1, c) || !IsInCone(loop, k + 1, a))) return false;
    for (const int x : loop) {
      if (x == a || x == b || x == c) continue;
      if (Turn(a, b, x) >= 0 && Turn(b, c, x) >= 0 && Turn(c, a, x) >= 0) return false;
    }
    return true;
  }

  void ClipEars(Loop loop) {
    while (loop.size() >= 3) {
      std::ptrdiff_t ear = -1;
      for (std::ptrdiff_t k = 0; k < std::ssize(loop) && ear < 0; ++k) {
        if (IsEar(loop, k)) ear = k;
      }
      if (ear < 0) return;
      triangles_.push_back({At(loop, ear - 1), At(loop, ear), At(loop, ear + 1)});
      loop.erase(loop.begin() + ear);
      if (loop.size() > 3) loop = WithoutSpikes(std::move(loop));
    }
  }

  SumGeometry& geometry_;
  const int plane_;
  int axis_, sense_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

std::vector<std::array<int, 3>> TriangulateCell(SumGeometry* geometry, int plane,
                                                std::span<const std::span<const int>> loops) {
  return Triangulator(geometry, plane).Run(loops);
}

}  // namespace touchstone::internal
