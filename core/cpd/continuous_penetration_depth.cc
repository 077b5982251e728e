// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/continuous_penetration_depth.h"

#include <utility>

#include "touchstone/core/cpd/continuous_solver_internal.h"

namespace touchstone {

std::string_view ToString(ContinuousDepthStatus status) {
  constexpr std::string_view kNames[] = {"separate", "found", "approximate", "limit"};
  return kNames[static_cast<int>(status)];
}

class ContinuousPenetrationDepth::Implementation : public internal::ContinuousSolver {
 public:
  using ContinuousSolver::ContinuousSolver;
};

ContinuousPenetrationDepth::ContinuousPenetrationDepth(TriangleMesh a, TriangleMesh b,
                                                       const ContinuousDepthOptions& options)
    : implementation_(std::make_unique<Implementation>(std::move(a), std::move(b), options)) {}
ContinuousPenetrationDepth::~ContinuousPenetrationDepth() = default;
ContinuousPenetrationDepth::ContinuousPenetrationDepth(ContinuousPenetrationDepth&&) noexcept =
    default;
ContinuousPenetrationDepth& ContinuousPenetrationDepth::operator=(
    ContinuousPenetrationDepth&&) noexcept = default;

ContinuousDepthResult ContinuousPenetrationDepth::Update(const RelativePose& pose) {
  return implementation_->Update(pose);
}

std::optional<ContinuousDepthState> ContinuousPenetrationDepth::state() const {
  return implementation_->state();
}

void ContinuousPenetrationDepth::set_state(const std::optional<ContinuousDepthState>& state) {
  implementation_->set_state(state);
}

std::optional<PhongPatch> ContinuousPenetrationDepth::patch() const {
  return implementation_->patch();
}

std::optional<Eigen::Matrix3d> ContinuousPenetrationDepth::RateOfTurn() {
  return implementation_->RateOfTurn();
}

void ContinuousPenetrationDepth::Forget() { implementation_->Forget(); }

const LocalSum& ContinuousPenetrationDepth::local_sum() const {
  return implementation_->local_sum();
}

}  // namespace touchstone
