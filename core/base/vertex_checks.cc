// SPDX-License-Identifier: MIT
#include "touchstone/core/base/vertex_checks.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr double kMinSize = 1e-100;
constexpr double kMaxSize = 1e100;

}  // namespace

Status CheckVertices(std::span<const Vector3d> vertices) {
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!vertices[v].allFinite()) {
      return {StatusCode::kNonFinite, ElementKind::kVertex, static_cast<int>(v), -1,
              "vertex " + std::to_string(v) + " has a coordinate that is not finite"};
    }
  }
  if (vertices.size() < 4) {
    return {StatusCode::kTooFewVertices, ElementKind::kNone, -1, -1,
            "a body has four vertices at least, not " + std::to_string(vertices.size())};
  }
  double largest = 0.0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double size = vertices[v].cwiseAbs().maxCoeff();
    largest = std::max(largest, size);
    if (size > kMaxSize) {
      return {StatusCode::kOutOfRange, ElementKind::kVertex, static_cast<int>(v), -1,
              "vertex " + std::to_string(v) + " has a coordinate above 1e100"};
    }
  }
  if (largest < kMinSize) {
    return {StatusCode::kOutOfRange, ElementKind::kNone, -1, -1,
            "all coordinates are below 1e-100: scale the body"};
  }
  return {};
}

Status CheckDistinct(std::span<const Vector3d> vertices) {
  std::vector<int> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int v, int w) {
    for (int i = 0; i < 3; ++i) {
      if (vertices[v][i] != vertices[w][i]) return vertices[v][i] < vertices[w][i];
    }
    return v < w;
  });
  std::pair<int, int> first(-1, -1);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const int v = order[i - 1], w = order[i];
    if (vertices[v] == vertices[w] && (first.first < 0 || v < first.first)) first = {v, w};
  }
  if (first.first < 0) return {};
  return {StatusCode::kDuplicateVertex, ElementKind::kVertex, first.first, first.second,
          "vertices " + std::to_string(first.first) + " and " + std::to_string(first.second) +
              " are equal"};
}

}  // namespace touchstone
