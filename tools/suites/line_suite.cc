// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/line_suite.h"

#include <vector>

#include "touchstone/tools/suites/placement.h"
#include "touchstone/tools/suites/recent_cache.h"

namespace touchstone {
namespace {

constexpr int kOrientations = 4;

struct Block {
  ConvexPolyhedron p, q;
  std::vector<ContactLine> lines;
};

}  // namespace

PlacedPair LineSuite::Generate(std::uint64_t seed, std::uint64_t index) const {
  thread_local RecentCache<Block> cache;
  const std::uint64_t line = index / kPlacementCount;
  const std::uint64_t number = line / kOrientations;
  const Block& block = cache.Get(name(), seed, number, [&] {
    Random random(name(), seed, 3 * number);
    Pair bodies = MakePair(random);
    std::vector<ContactLine> lines;
    for (int i = 0; i < kOrientations; ++i) {
      const Eigen::Matrix3d rotation = MakeRotation(random);
      lines.push_back(FindContactLine(bodies.first, bodies.second, rotation, random.SpherePoint()));
    }
    return Block{std::move(bodies.first), std::move(bodies.second), std::move(lines)};
  });
  Random of_block(name(), seed, 3 * number + 1);
  Random of_index(name(), seed, 3 * index + 2);
  return Finish({block.p, block.q,
                 PoseOfPlacement(block.lines[line % kOrientations],
                                 static_cast<int>(index % kPlacementCount))},
                of_block, of_index);
}

StatusOr<ConvexPolyhedron> MapBody(
    const ConvexPolyhedron& body,
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector3d& v : body.vertices()) vertices.push_back(map(v));
  std::vector<std::vector<int>> faces;
  for (int f = 0; f < body.face_count(); ++f)
    faces.emplace_back(body.face(f).begin(), body.face(f).end());
  return ConvexPolyhedron::Build(vertices, faces);
}

}  // namespace touchstone
