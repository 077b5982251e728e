// SPDX-License-Identifier: MIT
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "touchstone/tools/shapes/shape.h"

namespace touchstone {
namespace {

using Edge = std::pair<int, int>;  // as one face runs it

class Refiner {
 public:
  explicit Refiner(const Shape& shape) : shape_(shape) {
    for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f) Register(f);
  }

  void HalveLongestEdge() {
    while (true) {
      const auto [length, tail, head] = queue_.top();
      queue_.pop();
      const auto left = face_of_.find({tail, head});
      if (left == face_of_.end()) continue;  // an edge that has been halved
      Halve(tail, head, left->second, face_of_.at({head, tail}));
      return;
    }
  }

  const Shape& shape() const { return shape_; }

 private:
  void Register(int f) {
    for (int k = 0; k < 3; ++k) {
      const int a = shape_.faces[f][k], b = shape_.faces[f][(k + 1) % 3];
      face_of_[{a, b}] = f;
      if (a < b) queue_.push({(shape_.vertices[a] - shape_.vertices[b]).squaredNorm(), a, b});
    }
  }

  // Splits both faces of an edge at its middle.
  void Halve(int tail, int head, int left, int right) {
    const Eigen::Vector3d middle = 0.5 * (shape_.vertices[tail] + shape_.vertices[head]);
    const int m = shape_.AddVertex(middle[0], middle[1], middle[2]);
    face_of_.erase({tail, head});
    face_of_.erase({head, tail});
    Split(left, tail, head, m);
    Split(right, head, tail, m);
  }

  void Split(int f, int tail, int head, int middle) {
    const Triangle face = shape_.faces[f];
    int apex = face[0];
    for (const int v : face) {
      if (v != tail && v != head) apex = v;
    }
    shape_.faces[f] = {tail, middle, apex};
    shape_.faces.push_back({middle, head, apex});
    Register(f);
    Register(static_cast<int>(shape_.faces.size()) - 1);
    // Edges between old vertices are listed once, whichever face lists them.
    if (tail > apex) queue_.push({Squared(tail, apex), apex, tail});
    if (head < apex) queue_.push({Squared(head, apex), head, apex});
    queue_.push({Squared(tail, middle), tail, middle});
    queue_.push({Squared(middle, head), middle, head});
    queue_.push({Squared(middle, apex), middle, apex});
  }

  double Squared(int a, int b) const {
    return (shape_.vertices[a] - shape_.vertices[b]).squaredNorm();
  }

  Shape shape_;
  std::map<Edge, int> face_of_;
  std::priority_queue<std::tuple<double, int, int>> queue_;
};

}  // namespace

Shape Refined(const Shape& shape, int face_count) {
  if (static_cast<int>(shape.faces.size()) >= face_count) return shape;
  Refiner refiner(shape);
  while (static_cast<int>(refiner.shape().faces.size()) < face_count) refiner.HalveLongestEdge();
  return refiner.shape();
}

}  // namespace touchstone
