// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/result.h"

namespace touchstone {

std::string_view ToString(DistanceKind kind) {
  switch (kind) {
    case DistanceKind::kSeparate:
      return "separate";
    case DistanceKind::kMeet:
      return "meet";
    case DistanceKind::kUndecided:
      return "undecided";
  }
  return "?";
}

std::string_view ToString(TravelKind kind) {
  switch (kind) {
    case TravelKind::kInterval:
      return "interval";
    case TravelKind::kNever:
      return "never";
    case TravelKind::kUndecided:
      return "undecided";
  }
  return "?";
}

std::string_view ToString(PublishedTravelKind kind) {
  switch (kind) {
    case PublishedTravelKind::kTravel:
      return "travel";
    case PublishedTravelKind::kNever:
      return "never";
    case PublishedTravelKind::kCoincident:
      return "coincident";
    case PublishedTravelKind::kOnBoundary:
      return "on_boundary";
  }
  return "?";
}

}  // namespace touchstone
