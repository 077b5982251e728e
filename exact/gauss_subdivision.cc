// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/gauss_subdivision.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "touchstone/exact/hull_of_integers_internal.h"

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;

// The sign of n_m.x - w_m for the point x where planes a, b, c meet, their normals
// counterclockwise.
int SideOfCorner(const Subdivision& s, int a, int b, int c, int m) {
  const IntegerVector &na = s.normals[a], &nb = s.normals[b], &nc = s.normals[c];
  const IntegerVector& n = s.normals[m];
  const IntegerVector bc = Cross(nb, nc);
  const Integer height = s.offsets[a] * Dot(n, bc) + s.offsets[b] * Dot(n, Cross(nc, na)) +
                         s.offsets[c] * Dot(n, Cross(na, nb));
  return sgn(Integer(height - s.offsets[m] * Dot(na, bc)));
}

class PolyhedronChecker {
 public:
  explicit PolyhedronChecker(const Subdivision& s) : s_(s) {}

  std::string Check() {
    for (const Integer& offset : s_.offsets) {
      if (sgn(offset) <= 0) return "a plane does not pass outside the origin";
    }
    for (std::size_t v = 0; v < s_.vertices.size(); ++v) {
      const std::string error = CheckVertex(static_cast<int>(v));
      if (!error.empty()) return error + ", vertex " + std::to_string(v);
    }
    for (const auto& [ends, vertex] : left_of_) {
      if (left_of_.count({ends.second, ends.first}) == 0) return "an edge has one vertex";
      const std::string error = CheckEdge(ends.first, ends.second, vertex);
      if (!error.empty()) return error;
    }
    const std::size_t edges = left_of_.size() / 2;
    if (s_.vertices.size() + s_.normals.size() != edges + 2)
      return "not a sphere by Euler's formula";
    if (!IsConnected()) return "not connected";
    return CountHolding() == 1 ? "" : "a direction is not covered once";
  }

 private:
  std::string CheckVertex(int v) {
    const std::vector<int>& faces = s_.vertices[v];
    const std::size_t count = faces.size();
    if (count < 3) return "fewer than three planes meet";
    for (std::size_t i = 0; i < count; ++i) {
      const int a = faces[i], b = faces[(i + 1) % count], c = faces[(i + 2) % count];
      if (sgn(Determinant(s_.normals[a], s_.normals[b], s_.normals[c])) <= 0) {
        return "the normals do not run counterclockwise";
      }
      if (SideOfCorner(s_, faces[0], faces[1], faces[2], a) != 0) return "planes do not meet";
      if (!left_of_.emplace(std::pair(a, b), v).second) return "an edge comes twice";
    }
    return "";
  }

  std::string CheckEdge(int tail, int head, int vertex) const {
    const int other = left_of_.at({head, tail});
    const std::vector<int>& own = s_.vertices[vertex];
    for (const int m : s_.vertices[other]) {
      if (m == tail || m == head) continue;
      if (SideOfCorner(s_, own[0], own[1], own[2], m) >= 0)
        return "not convex, or flat, at an edge";
    }
    return "";
  }

  bool IsConnected() const {
    std::vector<bool> is_seen(s_.vertices.size());
    std::vector<int> stack = {0};
    is_seen[0] = true;
    std::size_t seen = 1;
    while (!stack.empty()) {
      const std::vector<int>& faces = s_.vertices[stack.back()];
      stack.pop_back();
      for (std::size_t i = 0; i < faces.size(); ++i) {
        const int next = left_of_.at({faces[(i + 1) % faces.size()], faces[i]});
        if (is_seen[next]) continue;
        is_seen[next] = true;
        ++seen;
        stack.push_back(next);
      }
    }
    return seen == s_.vertices.size();
  }

  // How many regions hold a direction inside the first.
  int CountHolding() const {
    IntegerVector x = {0, 0, 0};
    for (const int f : s_.vertices[0]) {
      for (int i = 0; i < 3; ++i) x[i] += s_.normals[f][i] * (1 + f % 7);
    }
    int count = 0;
    for (const std::vector<int>& faces : s_.vertices) {
      bool holds = true;
      for (std::size_t i = 0; i < faces.size() && holds; ++i) {
        holds = sgn(Determinant(s_.normals[faces[i]], s_.normals[faces[(i + 1) % faces.size()]],
                                x)) >= 0;
      }
      count += holds;
    }
    return count;
  }

  const Subdivision& s_;
  std::map<std::pair<int, int>, int> left_of_;
};

std::vector<std::vector<int>> NeighborsOf(const Subdivision& s) {
  std::vector<std::vector<int>> neighbors(s.normals.size());
  for (const std::vector<int>& faces : s.vertices) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      neighbors[faces[i]].push_back(faces[(i + 1) % faces.size()]);
    }
  }
  return neighbors;
}

IntegerVector Reduced(const IntegerVector& v) {
  const Integer divisor = gcd(gcd(v[0], v[1]), v[2]);
  return {v[0] / divisor, v[1] / divisor, v[2] / divisor};
}

// Edges of the mesh that are not flat, with the normals beside them.
struct GaussArc {
  int tail, head;
  bool is_reflex;
  IntegerVector along, left, right;
};

std::vector<GaussArc> ArcsOf(const TriangleMesh& mesh, bool with_reflex) {
  std::vector<double> coordinates;
  for (const Vector3d& x : mesh.vertices())
    coordinates.insert(coordinates.end(), x.begin(), x.end());
  const int exponent =
      CommonExponent(coordinates.data(), static_cast<int>(coordinates.size()), 1100);
  std::vector<IntegerVector> points;
  for (const Vector3d& x : mesh.vertices()) points.push_back(ToInteger(x, exponent));
  std::map<std::pair<int, int>, int> face_left_of;
  std::vector<IntegerVector> normals;
  for (const auto& [a, b, c] : mesh.faces()) {
    const int f = static_cast<int>(normals.size());
    normals.push_back(Cross(points[b] - points[a], points[c] - points[a]));
    face_left_of[{a, b}] = face_left_of[{b, c}] = face_left_of[{c, a}] = f;
  }
  std::vector<GaussArc> arcs;
  for (const auto& [ends, left] : face_left_of) {
    const auto& [tail, head] = ends;
    if (tail > head) continue;
    const int right = face_left_of.at({head, tail});
    const IntegerVector along = points[head] - points[tail];
    const int bend = sgn(Determinant(along, normals[left], normals[right]));
    if (bend == 0 || (bend < 0 && !with_reflex)) continue;
    arcs.push_back({tail, head, bend < 0, along, normals[left], normals[right]});
  }
  return arcs;
}

}  // namespace

std::string FindPolyhedronError(const Subdivision& subdivision) {
  return PolyhedronChecker(subdivision).Check();
}

// From the left face's normal to the right one's is counterclockwise round the edge, convex or
// reflex, by less than a full circle; the steps are each shorter than half a one.
ArcFindings FindMissingArcs(const TriangleMesh& mesh, const Subdivision& subdivision,
                            bool with_reflex) {
  const std::vector<std::vector<int>> neighbors = NeighborsOf(subdivision);
  std::map<IntegerVector, int> face_along;
  for (std::size_t i = 0; i < subdivision.normals.size(); ++i) {
    face_along[Reduced(subdivision.normals[i])] = static_cast<int>(i);
  }
  ArcFindings findings;
  for (const GaussArc& arc : ArcsOf(mesh, with_reflex)) {
    ++findings.arcs;
    const auto start = face_along.find(Reduced(arc.left));
    const auto end = face_along.find(Reduced(arc.right));
    bool is_there = start != face_along.end() && end != face_along.end();
    for (int at = is_there ? start->second : -1; is_there && at != end->second;) {
      int next = -1;
      for (const int j : neighbors[at]) {
        const IntegerVector& n = subdivision.normals[j];
        if (DotSign(arc.along, n) == 0 &&
            sgn(Determinant(arc.along, subdivision.normals[at], n)) > 0) {
          next = j;
        }
      }
      at = next;
      // Back at the start: all the way round and past the end.
      is_there = next >= 0 && next != start->second;
    }
    if (!is_there) findings.missing.push_back({arc.tail, arc.head, arc.is_reflex});
  }
  return findings;
}

ArcFindings FindMissingArcsNear(const TriangleMesh& mesh, const Subdivision& subdivision,
                                bool with_reflex, double tolerance) {
  const std::vector<std::vector<int>> neighbors = NeighborsOf(subdivision);
  std::vector<Vector3d> units;
  for (const IntegerVector& n : subdivision.normals) units.push_back(ToDirection(n).normalized());
  ArcFindings findings;
  for (const GaussArc& arc : ArcsOf(mesh, with_reflex)) {
    ++findings.arcs;
    const Vector3d along = ToDirection(arc.along).normalized();
    const Vector3d left = ToDirection(arc.left).normalized();
    const Vector3d right = ToDirection(arc.right).normalized();
    // How far round the edge, from the left normal on.
    const auto angle = [&](const Vector3d& x) {
      const double turned = std::atan2(along.dot(left.cross(x)), left.dot(x));
      return turned < -tolerance ? turned + 2.0 * std::acos(-1.0) : turned;
    };
    std::set<int> seen;
    std::vector<int> stack;
    for (std::size_t i = 0; i < units.size(); ++i) {
      if ((units[i] - left).norm() <= tolerance) stack.push_back(static_cast<int>(i));
    }
    seen.insert(stack.begin(), stack.end());
    bool is_there = false;
    while (!stack.empty() && !is_there) {
      const int at = stack.back();
      stack.pop_back();
      is_there = (units[at] - right).norm() <= tolerance;
      for (const int j : neighbors[at]) {
        if (std::abs(along.dot(units[j])) > tolerance) continue;
        const double step = angle(units[j]) - angle(units[at]);
        if (step < -tolerance || step > 3.1415926 || angle(units[j]) > angle(right) + tolerance) {
          continue;
        }
        if (seen.insert(j).second) stack.push_back(j);
      }
    }
    if (!is_there) findings.missing.push_back({arc.tail, arc.head, arc.is_reflex});
  }
  return findings;
}

bool IsIntersectionOfHalfSpaces(const Subdivision& subdivision) {
  // Poles on one grid: n times the product of the others' offsets would do, the least multiple is
  // shorter.
  Integer common = 1;
  for (const Integer& offset : subdivision.offsets) common = lcm(common, offset);
  std::vector<IntegerVector> poles;
  for (std::size_t i = 0; i < subdivision.normals.size(); ++i) {
    poles.push_back(Integer(common / subdivision.offsets[i]) * subdivision.normals[i]);
  }
  std::map<int, std::set<int>> regions_of_face;
  for (std::size_t v = 0; v < subdivision.vertices.size(); ++v) {
    for (const int f : subdivision.vertices[v]) regions_of_face[f].insert(static_cast<int>(v));
  }
  std::size_t expected = 0;
  for (const std::vector<int>& faces : subdivision.vertices) expected += faces.size() - 2;
  const auto triangles = HullOfIntegers(poles);
  if (triangles.size() != expected) return false;
  for (const auto& [a, b, c] : triangles) {
    bool has_region = false;
    for (const int v : regions_of_face[a]) {
      has_region |= regions_of_face[b].count(v) != 0 && regions_of_face[c].count(v) != 0;
    }
    if (!has_region) return false;
  }
  return true;
}

}  // namespace touchstone::exact
