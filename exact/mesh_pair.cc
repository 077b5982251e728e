// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/mesh_pair.h"

#include <algorithm>
#include <climits>
#include <numeric>

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;

IntegerMatrix ToInteger(const Eigen::Matrix3d& m, int exponent) {
  IntegerMatrix result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[i][j] = exact::ToInteger(m(i, j), exponent);
  }
  return result;
}

int ExponentOf(const TriangleMesh& mesh) {
  int exponent = INT_MAX;
  for (const Vector3d& x : mesh.vertices()) exponent = CommonExponent(x.data(), 3, exponent);
  return exponent;
}

void ShiftLeft(IntegerVector& v, int bits) {
  for (Integer& x : v) mpz_mul_2exp(x.get_mpz_t(), x.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
}

bool BoxesMeet(const FaceTree::Node& a, const FaceTree::Node& b, const Vector3d& offset,
               double margin) {
  for (int i = 0; i < 3; ++i) {
    if (a.low[i] > b.high[i] + offset[i] + margin || b.low[i] + offset[i] > a.high[i] + margin) {
      return false;
    }
  }
  return true;
}

}  // namespace

FaceTree::FaceTree(const std::vector<Vector3d>& points, std::span<const std::array<int, 3>> faces) {
  std::vector<Node> leaves(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = faces[f];
    leaves[f].low = points[a].cwiseMin(points[b]).cwiseMin(points[c]);
    leaves[f].high = points[a].cwiseMax(points[b]).cwiseMax(points[c]);
    leaves[f].face = static_cast<int>(f);
  }
  std::vector<int> members(faces.size());
  std::iota(members.begin(), members.end(), 0);
  nodes_.reserve(2 * faces.size());
  Add(leaves, members);
}

int FaceTree::Add(const std::vector<Node>& leaves, std::span<int> members) {
  const int index = static_cast<int>(nodes_.size());
  if (members.size() == 1) {
    nodes_.push_back(leaves[members[0]]);
    return index;
  }
  Node node = leaves[members[0]];
  node.face = -1;
  for (const int m : members) {
    node.low = node.low.cwiseMin(leaves[m].low);
    node.high = node.high.cwiseMax(leaves[m].high);
  }
  nodes_.push_back(node);
  int axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const auto half = static_cast<std::ptrdiff_t>(members.size() / 2);
  std::nth_element(members.begin(), members.begin() + half, members.end(), [&](int m, int n) {
    const double x = leaves[m].low[axis] + leaves[m].high[axis];
    const double y = leaves[n].low[axis] + leaves[n].high[axis];
    return x != y ? x < y : m < n;
  });
  const int left = Add(leaves, members.first(half));
  const int right = Add(leaves, members.subspan(half));
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

std::vector<std::pair<int, int>> NearFaces(const FaceTree& a, const FaceTree& b,
                                           const Vector3d& offset, double margin) {
  std::vector<std::pair<int, int>> near, stack = {{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const FaceTree::Node &m = a.nodes()[i], &n = b.nodes()[j];
    if (!BoxesMeet(m, n, offset, margin)) continue;
    if (m.face >= 0 && n.face >= 0) {
      near.emplace_back(m.face, n.face);
    } else if (n.face >= 0 || (m.face < 0 && (m.high - m.low).sum() > (n.high - n.low).sum())) {
      stack.emplace_back(m.left, j);
      stack.emplace_back(m.right, j);
    } else {
      stack.emplace_back(i, n.left);
      stack.emplace_back(i, n.right);
    }
  }
  return near;
}

PlacedMeshPair::PlacedMeshPair(const TriangleMesh& a, const TriangleMesh& b,
                               const RelativePose& pose)
    : a_(a), b_(b) {
  // A: scale * a. B: matrix * b + shift. Exponents of the three, brought to one.
  IntegerMatrix matrix;
  IntegerVector shift;
  int of_a = ExponentOf(a), of_b = ExponentOf(b), of_scale = 0, of_matrix = 0, of_shift = 0;
  if (pose.world().has_value()) {
    const auto& [p, q] = *pose.world();
    const int of_p = CommonExponent(p.rotation.data(), 9, INT_MAX);
    const int of_q = CommonExponent(q.rotation.data(), 9, INT_MAX);
    const int of_t =
        CommonExponent(p.translation.data(), 3, CommonExponent(q.translation.data(), 3, INT_MAX));
    const IntegerMatrix rp = ToInteger(p.rotation, of_p);
    const IntegerMatrix adjugate = Transposed(Cofactors(rp));
    scale_ = Determinant(rp[0], rp[1], rp[2]);
    matrix = Multiply(adjugate, ToInteger(q.rotation, of_q));
    of_scale = 3 * of_p;
    of_matrix = 2 * of_p + of_q;
    of_shift = of_t == INT_MAX ? INT_MAX : 2 * of_p + of_t;
    if (of_t != INT_MAX) {
      shift = Multiply(
          adjugate, exact::ToInteger(q.translation, of_t) - exact::ToInteger(p.translation, of_t));
    }
  } else {
    of_matrix = CommonExponent(pose.rotation().data(), 9, INT_MAX);
    of_shift = CommonExponent(pose.translation().data(), 3, INT_MAX);
    matrix = ToInteger(pose.rotation(), of_matrix);
    if (of_shift != INT_MAX) shift = exact::ToInteger(pose.translation(), of_shift);
  }
  const int common = std::min({of_a + of_scale, of_b + of_matrix, of_shift});
  if (of_shift != INT_MAX) ShiftLeft(shift, of_shift - common);
  for (const Vector3d& x : a.vertices()) {
    points_a_.push_back(scale_ * exact::ToInteger(x, of_a));
    ShiftLeft(points_a_.back(), of_a + of_scale - common);
  }
  for (const Vector3d& x : b.vertices()) {
    IntegerVector y = Multiply(matrix, exact::ToInteger(x, of_b));
    ShiftLeft(y, of_b + of_matrix - common);
    for (int i = 0; i < 3; ++i) y[i] += shift[i];
    points_b_.push_back(std::move(y));
  }
  // A true length is an integer length * 2^common / (scale * 2^of_scale).
  exponent_ = common - of_scale;
  const auto to_doubles = [&](const std::vector<IntegerVector>& points) {
    std::vector<Vector3d> doubles;
    for (const IntegerVector& x : points) {
      doubles.emplace_back(Quotient(x[0], scale_, exponent_), Quotient(x[1], scale_, exponent_),
                           Quotient(x[2], scale_, exponent_));
      size_ = std::max(size_, doubles.back().cwiseAbs().maxCoeff());
    }
    return doubles;
  };
  doubles_a_ = to_doubles(points_a_);
  doubles_b_ = to_doubles(points_b_);
  tree_a_ = FaceTree(doubles_a_, a_.faces());
  tree_b_ = FaceTree(doubles_b_, b_.faces());
}

ExactTranslation::ExactTranslation(const Vector3d& x) {
  exponent = CommonExponent(x.data(), 3, INT_MAX);
  if (exponent == INT_MAX) exponent = 0;
  coordinates = exact::ToInteger(x, exponent);
}

ExactTranslation::ExactTranslation(const std::array<mpq_class, 3>& x) {
  for (const mpq_class& value : x) denominator = lcm(denominator, value.get_den());
  for (int i = 0; i < 3; ++i) {
    coordinates[i] = x[i].get_num() * (denominator / x[i].get_den());
  }
}

}  // namespace touchstone::exact
