// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/conform_internal.h"

#include <algorithm>
#include <cstdint>
#include <unordered_set>

namespace touchstone::internal {
namespace {

class Conformer {
 public:
  explicit Conformer(HalfSpaceIntersection* polyhedron) : polyhedron_(*polyhedron) {}

  // Keeps the edge from later cuts if it is there and not flat.
  void KeepIfThere(int from, int to) {
    const int first = polyhedron_.corner_of_plane(from);
    int t = first;
    do {
      const int k = polyhedron_.IndexOf(t, from);
      if (polyhedron_.corner(t)[(k + 1) % 3] == to) {
        if (!polyhedron_.IsFlat(t, k)) Keep(from, to);
        return;
      }
      t = polyhedron_.neighbor(t, (k + 2) % 3);
    } while (t != first);
  }

  std::vector<int> Enforce(int from, int to, const Direction& pole) {
    std::vector<int> chain = {from};
    if (IsKept(from, to)) return {from, to};
    while (chain.back() != to) {
      const int next = Step(chain.back(), to, pole);
      Keep(chain.back(), next);
      chain.push_back(next);
    }
    return chain;
  }

 private:
  static std::uint64_t Key(int p, int q) {
    return static_cast<std::uint64_t>(std::min(p, q)) << 32 |
           static_cast<std::uint32_t>(std::max(p, q));
  }
  void Keep(int p, int q) { kept_.insert(Key(p, q)); }
  bool IsKept(int p, int q) const { return kept_.count(Key(p, q)) != 0; }

  // The next plane along the arc such that there is an edge to it that is not flat.
  int Step(int from, int to, const Direction& pole) {
    const int first = polyhedron_.corner_of_plane(from);
    int t = first;
    do {
      const int k = polyhedron_.IndexOf(t, from);
      const int r = polyhedron_.corner(t)[(k + 1) % 3], s = polyhedron_.corner(t)[(k + 2) % 3];
      if (r == to) {
        if (!polyhedron_.IsFlat(t, k)) return to;
        return CutAlongFlatEdge(from, to, pole, t, polyhedron_.neighbor(t, k));
      }
      // The arc leaves between r, on its right, and s, on its left.
      if (s != to && SideOf(pole, polyhedron_.direction(r)) < 0 &&
          SideOf(pole, polyhedron_.direction(s)) > 0) {
        return CutEdge(from, to, pole, t, (k + 1) % 3);
      }
      t = polyhedron_.neighbor(t, (k + 2) % 3);
    } while (t != first);
    return to;  // not reached: the arc leaves somewhere
  }

  // Where the arc meets the edge from r to s: on both great circles, between r and s.
  int CutEdge(int from, int to, const Direction& pole, int t, int k) {
    const Direction& r = polyhedron_.direction(polyhedron_.corner(t)[k]);
    const Direction& s = polyhedron_.direction(polyhedron_.corner(t)[(k + 1) % 3]);
    const IntegerVector meeting =
        Multiple(Dot(pole.exact, s.exact), r.exact) + Multiple(-Dot(pole.exact, r.exact), s.exact);
    const int corners[] = {t, polyhedron_.neighbor(t, k)};
    return CutNear(meeting, from, to, pole, corners);
  }

  int CutAlongFlatEdge(int from, int to, const Direction& pole, int t, int across) {
    const Direction &p = polyhedron_.direction(from), &q = polyhedron_.direction(to);
    const int digits = std::max(DigitsOf(p.exact), DigitsOf(q.exact));
    const int corners[] = {t, across};
    return CutNear(
        Shifted(p.exact, digits - DigitsOf(p.exact)) + Shifted(q.exact, digits - DigitsOf(q.exact)),
        from, to, pole, corners);
  }

  // Cuts along a direction of the arc near one on it: u -> pole x u turns any vector into one on
  // the great circle, and u = meeting x pole into the meeting point itself.
  int CutNear(const IntegerVector& meeting, int from, int to, const Direction& pole,
              std::span<const int> corners) {
    const IntegerVector exact = Cross(meeting, pole.exact);
    const auto is_kept = [this](int p, int q) { return IsKept(p, q); };
    for (int digits = 40;; digits *= 2) {
      const int drop = std::max(0, DigitsOf(exact) - digits);
      const IntegerVector near = Cross(pole.exact, Shifted(exact, -drop));
      if (DigitsOf(near) != 0) {
        const Direction m = MakeDirection(near);
        if (TurnOf(pole, polyhedron_.direction(from), m) > 0 &&
            TurnOf(pole, m, polyhedron_.direction(to)) > 0) {
          if (const auto plane = polyhedron_.CutCorners(m, corners, is_kept)) return *plane;
        }
      }
      // Not reached: at the point itself the cut succeeds.
      if (drop == 0) return to;
    }
  }

  HalfSpaceIntersection& polyhedron_;
  std::unordered_set<std::uint64_t> kept_;
};

}  // namespace

std::vector<std::vector<int>> MakeConforming(std::span<const ArcPiece> pieces,
                                             std::span<const Direction> poles,
                                             std::span<const int> plane_of_vertex,
                                             HalfSpaceIntersection* polyhedron) {
  Conformer conformer(polyhedron);
  for (const ArcPiece& piece : pieces) {
    conformer.KeepIfThere(plane_of_vertex[piece.tail], plane_of_vertex[piece.head]);
  }
  std::vector<std::vector<int>> chains;
  for (const ArcPiece& piece : pieces) {
    chains.push_back(conformer.Enforce(plane_of_vertex[piece.tail], plane_of_vertex[piece.head],
                                       poles[piece.pole]));
  }
  return chains;
}

}  // namespace touchstone::internal
