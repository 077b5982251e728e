// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/lattice_contact.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

// Which features of boxes are brought in contact.
enum class BoxContact { kFace, kEdge, kVertex };

class BoxSuite : public LatticeContactSuite {
 public:
  explicit BoxSuite(BoxContact contact) : contact_(contact) {}

  std::string_view name() const override {
    switch (contact_) {
      case BoxContact::kFace:
        return "boxes-face";
      case BoxContact::kEdge:
        return "boxes-edge";
      case BoxContact::kVertex:
        return "boxes-vertex";
    }
    return {};
  }
  std::string_view summary() const override {
    switch (contact_) {
      case BoxContact::kFace:
        return "boxes and diamonds, face on face, at 0, +-1 ulp, +-1e-12, +-1e-9 and wider";
      case BoxContact::kEdge:
        return "the same, an edge on a face or on an edge, parallel or crossed";
      case BoxContact::kVertex:
        return "the same, a vertex on a face, an edge or a vertex";
    }
    return {};
  }
  std::string_view attacks() const override {
    return "touch told from overlap and separate; exactly parallel features";
  }

 protected:
  ConvexPolyhedron MakeBody(Random& random) const override {
    const FacetStyle style = random.OneIn(4) ? FacetStyle::kTriangulated : FacetStyle::kMerged;
    const double height = random.Integer(1, 16);
    const std::vector<Eigen::Vector2d> diamond = Diamond(random);
    switch (random.Integer(0, 5)) {
      case 0:
        return PrismBody(diamond, height, false, style);
      case 1:
        return BipyramidBody(diamond, height, style);
      case 2:
        return BoxBody(Eigen::Vector3d::Constant(height), style);
      default: {
        const double x = random.Integer(1, 16);
        const double y = random.Integer(1, 16);
        return BoxBody({x, y, height}, style);
      }
    }
  }
  bool Wants(int p, int q) const override {
    switch (contact_) {
      case BoxContact::kFace:
        return p == 2 && q == 2;
      case BoxContact::kEdge:
        return (p == 1 && q >= 1) || (q == 1 && p >= 1);
      case BoxContact::kVertex:
        return p == 0 || q == 0;
    }
    return false;
  }

 private:
  // A box's section turned by an eighth: its edges point along the axes.
  static std::vector<Eigen::Vector2d> Diamond(Random& random) {
    const double x = random.Integer(1, 16);
    const double y = random.Integer(1, 16);
    return {{x, 0.0}, {0.0, y}, {-x, 0.0}, {0.0, -y}};
  }

  BoxContact contact_;
};

}  // namespace

std::unique_ptr<Suite> MakeBoxesFaceSuite() {
  return std::make_unique<BoxSuite>(BoxContact::kFace);
}
std::unique_ptr<Suite> MakeBoxesEdgeSuite() {
  return std::make_unique<BoxSuite>(BoxContact::kEdge);
}
std::unique_ptr<Suite> MakeBoxesVertexSuite() {
  return std::make_unique<BoxSuite>(BoxContact::kVertex);
}

}  // namespace touchstone
