// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/lattice_contact.h"

#include "touchstone/tools/suites/recent_cache.h"

namespace touchstone {
namespace {

constexpr int kContacts = 3;

struct Bodies {
  ConvexPolyhedron p, q;
};

struct Contact {
  Eigen::Matrix3d rotation;
  ContactFeatures features;
};

}  // namespace

PlacedPair LatticeContactSuite::Generate(std::uint64_t seed, std::uint64_t index) const {
  thread_local RecentCache<Bodies> bodies_cache;
  thread_local RecentCache<Contact> contact_cache;
  const std::uint64_t number = index / kContactOffsetCount;
  const Bodies& bodies = bodies_cache.Get(name(), seed, number / kContacts, [&] {
    Random random(name(), seed, 3 * (number / kContacts));
    ConvexPolyhedron p = MakeBody(random);
    // Now and then the same body twice.
    ConvexPolyhedron q = random.OneIn(8) ? p : MakeBody(random);
    return Bodies{std::move(p), std::move(q)};
  });
  const Contact& contact = contact_cache.Get(name(), seed, number, [&] {
    Random random(name(), seed, 3 * number + 1);
    const Eigen::Matrix3d rotation =
        random.OneIn(4) ? Eigen::Matrix3d::Identity() : random.AxisRotation();
    return Contact{rotation, DrawContact(random, bodies.p, bodies.q, rotation,
                                         [this](int p, int q) { return Wants(p, q); })};
  });
  Random random(name(), seed, 3 * index + 2);
  return PlaceAtContact(random, bodies.p, bodies.q, contact.rotation, contact.features,
                        static_cast<int>(index % kContactOffsetCount));
}

}  // namespace touchstone
