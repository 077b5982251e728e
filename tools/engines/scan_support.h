// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_ENGINES_SCAN_SUPPORT_H_
#define TOUCHSTONE_TOOLS_ENGINES_SCAN_SUPPORT_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// The support that most users of an engine write: look at every vertex. Made as fast as a scan can
// be, by the widest vectors of the processor.
class ScanSupport {
 public:
  explicit ScanSupport(const ConvexPolyhedron& body);

  // A vertex with the largest dot product as doubles see it.
  int Find(const Eigen::Vector3d& direction) const;

 private:
  static constexpr int kLanes = 8;
  struct alignas(64) Block {
    double x[kLanes], y[kLanes], z[kLanes];
  };
  static std::size_t Scan(const Block* blocks, std::size_t count, double nx, double ny, double nz);

  // The last is filled up with copies of vertex 0.
  std::vector<Block> blocks_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_ENGINES_SCAN_SUPPORT_H_
