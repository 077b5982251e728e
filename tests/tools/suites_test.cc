// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "touchstone/exact/decide.h"
#include "touchstone/tests/tools/program.h"
#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/suites/registry.h"

namespace touchstone {
namespace {

constexpr std::uint64_t kSeed = 1;

std::vector<std::unique_ptr<Suite>> AvailableSuites() {
  std::vector<std::unique_ptr<Suite>> suites = MakeSuites("");
  std::erase_if(suites, [](const auto& suite) { return !suite->unavailable().empty(); });
  return suites;
}

// FNV-1a over the bits of every double, and the loops of the faces.
class Hash {
 public:
  void Add(double value) { Add(std::bit_cast<std::uint64_t>(value)); }
  void Add(std::uint64_t bits) {
    for (int i = 0; i < 64; i += 8) hash_ = (hash_ ^ (bits >> i & 0xff)) * 0x100000001b3u;
  }
  void Add(const ConvexPolyhedron& body) {
    for (const Eigen::Vector3d& v : body.vertices()) {
      for (int i = 0; i < 3; ++i) Add(v[i]);
    }
    for (int f = 0; f < body.face_count(); ++f) {
      for (const int v : body.face(f)) Add(static_cast<std::uint64_t>(v));
    }
  }
  void Add(const PlacedPair& pair) {
    Add(pair.p);
    Add(pair.q);
    if (pair.pose.world()) {
      Add(pair.pose.world()->first.rotation, pair.pose.world()->first.translation);
      Add(pair.pose.world()->second.rotation, pair.pose.world()->second.translation);
    } else {
      Add(pair.pose.rotation(), pair.pose.translation());
    }
  }
  void Add(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) Add(rotation(i, j));
      Add(translation[i]);
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

// A changed value here means that old seeds no longer name the same queries: say so in the commit.
TEST(Suites, GiveTheSameDoublesOnEveryMachine) {
  const std::map<std::string, std::uint64_t> expected = {
      {"ellipsoid-1", 0x84c034b805c28702u},
      {"ellipsoid-2", 0x41647afbb720343eu},
      {"ellipsoid-4", 0x3f6292ca0e3d36dcu},
      {"ellipsoid-10", 0x6be699c2eaaa818du},
      {"ellipsoid-n20", 0x57a6e4453350d9afu},
      {"large", 0x397dfc14ec9ab9a3u},
      {"grid", 0x797f4671c833c596u},
      {"boxes-face", 0x794854043b2c4f92u},
      {"boxes-edge", 0xe587df327051a86bu},
      {"boxes-vertex", 0x8d470ad1dbc6932eu},
      {"prisms", 0x6ffba1a524cb9a7bu},
      {"ties", 0xb85b77919113399bu},
      {"tetrahedra", 0x842554d79ac938beu},
      {"touch-face-vertex", 0x9d25d76d0b56b64eu},
      {"touch-vertex-face", 0xb1076e158e89dfdcu},
      {"touch-edge-edge", 0xa3cde3f5d86acf5au},
      {"touch-face-edge", 0xd7c525ef1ca86973u},
      {"touch-edge-face", 0xfb5d1a6152d44c8cu},
      {"touch-face-face", 0xece3abc456c5ebd8u},
      {"slivers", 0x83f77f9e8f9554c7u},
      {"far", 0x24a542c512f5aa00u},
      {"scales", 0xa7e01406d1accd24u},
      {"near-coplanar", 0x351b2e9bf08a2267u},
      {"near-duplicates", 0xde61e86e2fc463d4u},
      {"off-orthonormal", 0x3324b7f6d4012679u},
      {"nested", 0x5d32f003b2cb6ca8u},
      {"world-poses", 0x837f50e4c0d4415fu},
      {"reported", 0x91fbb23387a0b8d7u},
      {"seldom", 0x779bddb61feaf9cbu},
  };
  for (const std::unique_ptr<Suite>& suite : AvailableSuites()) {
    Hash hash;
    for (std::uint64_t index = 0; index < 200; index += 3) hash.Add(suite->Generate(kSeed, index));
    const auto known = expected.find(std::string(suite->name()));
    EXPECT_TRUE(known != expected.end() && known->second == hash.value())
        << "now {\"" << suite->name() << "\", 0x" << std::hex << hash.value() << "u},";
  }
}

TEST(Suites, ArePureFunctionsOfSeedAndIndex) {
  for (const std::unique_ptr<Suite>& suite : AvailableSuites()) {
    const auto hash_of = [&](std::uint64_t seed, std::uint64_t index) {
      Hash hash;
      hash.Add(suite->Generate(seed, index));
      return hash.value();
    };
    const std::uint64_t first = hash_of(1, 17);
    // Evict what may be remembered, then ask again.
    for (std::uint64_t far = 1; far < 8; ++far) hash_of(2, 1000 * far);
    EXPECT_EQ(hash_of(1, 17), first) << suite->name();
    EXPECT_NE(hash_of(2, 1017), hash_of(3, 1017)) << suite->name();
  }
}

// Bodies are valid, what a suite is certain of is true, and all three verdicts come up.
TEST(Suites, AreValidAndMixed) {
  for (const std::unique_ptr<Suite>& suite : AvailableSuites()) {
    const std::uint64_t count = suite->name() == "large" ? 80 : 400;
    ExactBodies bodies;
    std::array<int, 4> verdicts{};
    for (std::uint64_t index = 0; index < count; ++index) {
      const PlacedPair pair = suite->Generate(kSeed, index);
      const exact::ExactBody p = bodies.Get(pair.p);
      const exact::ExactBody q = bodies.Get(pair.q);
      const Verdict verdict = exact::Decide(p, q, pair.pose).verdict;
      ++verdicts[static_cast<std::size_t>(verdict)];
      if (pair.expected) {
        EXPECT_EQ(ToString(verdict), ToString(*pair.expected)) << suite->name() << " " << index;
      }
      if (index % 20 == 0) {
        EXPECT_TRUE(pair.p.FindValidationError().ok()) << suite->name() << " " << index;
        EXPECT_TRUE(pair.q.FindValidationError().ok()) << suite->name() << " " << index;
      }
    }
    const auto at_least = [&](Verdict verdict, double share) {
      EXPECT_GE(verdicts[static_cast<std::size_t>(verdict)], share * static_cast<double>(count))
          << suite->name() << " " << ToString(verdict);
    };
    at_least(Verdict::kSeparate, 0.1);
    at_least(Verdict::kOverlap, 0.1);
    // General placements touch by luck only.
    const bool touches = suite->name() == "grid" || suite->name() == "prisms" ||
                         suite->name() == "ties" || suite->name() == "tetrahedra" ||
                         suite->name().starts_with("boxes") || suite->name().starts_with("touch");
    if (touches) at_least(Verdict::kTouch, 0.1);
    RecordProperty(std::string(suite->name()), std::to_string(verdicts[0]) + " separate, " +
                                                   std::to_string(verdicts[1]) + " touch, " +
                                                   std::to_string(verdicts[2]) + " overlap");
  }
}

TEST(Suites, MeshesTakesClosedMeshesOnly) {
  const TemporaryFolder folder("meshes");
  EXPECT_NE(MakeMeshesSuite(folder.path(""))->unavailable(), "");
  folder.Write("broken.off", "OFF\n4 4 0\n0 0\n");
  folder.Write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  EXPECT_NE(MakeMeshesSuite(folder.path(""))->unavailable(), "");
  folder.Write("closed.off",
               "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const std::unique_ptr<Suite> suite = MakeMeshesSuite(folder.path(""));
  ASSERT_EQ(suite->unavailable(), "");
  EXPECT_EQ(suite->Generate(kSeed, 5).p.vertex_count(), 4);
}

}  // namespace
}  // namespace touchstone
