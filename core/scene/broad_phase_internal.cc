// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/broad_phase_internal.h"

#include <algorithm>
#include <limits>

namespace touchstone::internal {

using Eigen::Vector3d;

std::unique_ptr<BroadPhaseFinder> MakeBroadPhase(BroadPhase kind) {
  switch (kind) {
    case BroadPhase::kTree:
      return std::make_unique<BoundingVolumeTree>();
    case BroadPhase::kSweep:
      return std::make_unique<Sweep>();
    case BroadPhase::kAllPairs:
      break;
  }
  return std::make_unique<AllPairs>();
}

namespace {

Box3 Union(const Box3& a, const Box3& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

bool Equal(const Box3& a, const Box3& b) { return a.low == b.low && a.high == b.high; }

// Grows with the surface; sums of lengths neither overflow nor need squares.
double Girth(const Box3& box) { return (box.high - box.low).sum(); }

void Know(std::vector<std::uint8_t>* known, int item) {
  if (item >= static_cast<int>(known->size())) known->resize(item + 1, 0);
  (*known)[item] = 1;
}

bool IsKnown(const std::vector<std::uint8_t>& known, int item) {
  return item < static_cast<int>(known.size()) && known[item] != 0;
}

}  // namespace

void BoundingVolumeTree::Update(std::span<const Box3> boxes, std::span<const int> items) {
  leaf_of_item_.resize(std::max(leaf_of_item_.size(), boxes.size()), kNone);
  for (const int item : items) changes_ += leaf_of_item_[item] == kNone ? 4 : 1;
  const bool rebuild = 2L * changes_ > item_count_ + 8L;
  for (const int item : items) {
    const int leaf = leaf_of_item_[item];
    if (leaf == kNone) {
      ++item_count_;
      if (rebuild) {
        leaf_of_item_[item] = NewNode();
      } else {
        Insert(item, boxes[item]);
      }
    } else if (!rebuild) {
      nodes_[leaf].box = boxes[item];
      Refit(nodes_[leaf].parent);
    }
  }
  if (rebuild) Rebuild(boxes);
}

int BoundingVolumeTree::NewNode() {
  if (free_.empty()) {
    nodes_.emplace_back();
    return static_cast<int>(nodes_.size()) - 1;
  }
  const int node = free_.back();
  free_.pop_back();
  nodes_[node] = Node{};
  return node;
}

void BoundingVolumeTree::Insert(int item, const Box3& box) {
  const int leaf = NewNode();
  nodes_[leaf].box = box;
  nodes_[leaf].left = item;
  leaf_of_item_[item] = leaf;
  if (root_ == kNone) {
    root_ = leaf;
    return;
  }
  int sibling = root_;
  while (!IsLeaf(sibling)) {
    const Node& node = nodes_[sibling];
    const auto growth = [&](int child) {
      return Girth(Union(nodes_[child].box, box)) - Girth(nodes_[child].box);
    };
    sibling = growth(node.left) <= growth(node.right) ? node.left : node.right;
  }
  const int parent = NewNode();
  const int above = nodes_[sibling].parent;
  nodes_[parent] = {Union(nodes_[sibling].box, box), above, sibling, leaf};
  nodes_[sibling].parent = nodes_[leaf].parent = parent;
  if (above == kNone) {
    root_ = parent;
  } else {
    (nodes_[above].left == sibling ? nodes_[above].left : nodes_[above].right) = parent;
    Refit(above);
  }
}

void BoundingVolumeTree::Remove(int item) {
  const int leaf = leaf_of_item_[item];
  if (leaf == kNone) return;
  leaf_of_item_[item] = kNone;
  --item_count_;
  ++changes_;
  free_.push_back(leaf);
  const int parent = nodes_[leaf].parent;
  if (parent == kNone) {
    root_ = kNone;
    return;
  }
  const int sibling = nodes_[parent].left == leaf ? nodes_[parent].right : nodes_[parent].left;
  const int above = nodes_[parent].parent;
  free_.push_back(parent);
  nodes_[sibling].parent = above;
  if (above == kNone) {
    root_ = sibling;
  } else {
    (nodes_[above].left == parent ? nodes_[above].left : nodes_[above].right) = sibling;
    Refit(above);
  }
}

void BoundingVolumeTree::Refit(int node) {
  while (node != kNone) {
    const Box3 box = Union(nodes_[nodes_[node].left].box, nodes_[nodes_[node].right].box);
    if (Equal(box, nodes_[node].box)) return;
    nodes_[node].box = box;
    node = nodes_[node].parent;
  }
}

void BoundingVolumeTree::Rebuild(std::span<const Box3> boxes) {
  changes_ = 0;
  items_.clear();
  for (std::size_t item = 0; item < leaf_of_item_.size(); ++item) {
    if (leaf_of_item_[item] != kNone) items_.push_back(static_cast<int>(item));
  }
  nodes_.clear();
  free_.clear();
  root_ = items_.empty() ? kNone : BuildNode(boxes, items_, kNone);
}

int BoundingVolumeTree::BuildNode(std::span<const Box3> boxes, std::span<int> items, int parent) {
  const int index = NewNode();
  nodes_[index].parent = parent;
  if (items.size() == 1) {
    nodes_[index].box = boxes[items[0]];
    nodes_[index].left = items[0];
    leaf_of_item_[items[0]] = index;
    return index;
  }
  // Halves by the boxes' lower ends along the axis on which they spread most.
  Box3 all = boxes[items[0]];
  Vector3d highest = all.low;
  for (const int item : items) {
    all = Union(all, boxes[item]);
    highest = highest.cwiseMax(boxes[item].low);
  }
  int axis = 0;
  (highest - all.low).maxCoeff(&axis);
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](int a, int b) {
                     const double x = boxes[a].low[axis], y = boxes[b].low[axis];
                     return x != y ? x < y : a < b;
                   });
  nodes_[index].box = all;
  const int left = BuildNode(boxes, items.first(half), index);
  const int right = BuildNode(boxes, items.subspan(half), index);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

void BoundingVolumeTree::FindPairs(std::span<const Box3> boxes, std::span<const int> items,
                                   std::vector<std::pair<int, int>>* pairs) {
  for (const int item : items) {
    const Box3& box = boxes[item];
    stack_.assign(1, root_);
    while (!stack_.empty()) {
      const int index = stack_.back();
      stack_.pop_back();
      const Node& node = nodes_[index];
      if (!Meet(node.box, box)) continue;
      if (node.right == kNone) {
        if (node.left != item) pairs->emplace_back(item, node.left);
        continue;
      }
      stack_.push_back(node.left);
      stack_.push_back(node.right);
    }
  }
}

std::size_t BoundingVolumeTree::bytes() const {
  return nodes_.capacity() * sizeof(Node) +
         (free_.capacity() + leaf_of_item_.capacity() + items_.capacity() + stack_.capacity()) *
             sizeof(int);
}

void Sweep::Update(std::span<const Box3> boxes, std::span<const int> items) {
  for (const int item : items) {
    if (IsKnown(is_known_, item)) continue;
    Know(&is_known_, item);
    entries_.push_back({0.0, 0.0, item});
  }
  Sort(boxes);
}

void Sweep::Remove(int item) {
  is_known_[item] = 0;
  std::erase_if(entries_, [&](const Entry& entry) { return entry.item == item; });
}

void Sweep::Sort(std::span<const Box3> boxes) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Entry& entry : entries_) {
    low = low.cwiseMin(boxes[entry.item].low);
    high = high.cwiseMax(boxes[entry.item].low);
  }
  if (!entries_.empty()) (high - low).maxCoeff(&axis_);
  widest_ = 0.0;
  for (Entry& entry : entries_) {
    entry.low = boxes[entry.item].low[axis_];
    entry.high = boxes[entry.item].high[axis_];
    widest_ = std::max(widest_, entry.high - entry.low);
  }
  const auto before = [](const Entry& a, const Entry& b) {
    return a.low != b.low ? a.low < b.low : a.item < b.item;
  };
  if (!std::is_sorted(entries_.begin(), entries_.end(), before)) {
    std::sort(entries_.begin(), entries_.end(), before);
  }
}

void Sweep::FindPairs(std::span<const Box3> boxes, std::span<const int> items,
                      std::vector<std::pair<int, int>>* pairs) {
  // All at once: each pair from the one that begins first.
  if (8 * items.size() > entries_.size()) {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      for (std::size_t j = i + 1; j < entries_.size() && entries_[j].low <= entries_[i].high; ++j) {
        const int a = entries_[i].item, b = entries_[j].item;
        if (Meet(boxes[a], boxes[b])) pairs->emplace_back(a, b);
      }
    }
    return;
  }
  for (const int item : items) {
    const Box3& box = boxes[item];
    // The widest box, rounded up, reaches back no further.
    const double from =
        box.low[axis_] - widest_ * (1.0 + 0x1p-50) - 0x1p-50 * std::abs(box.low[axis_]);
    auto entry = std::lower_bound(entries_.begin(), entries_.end(), from,
                                  [](const Entry& e, double x) { return e.low < x; });
    for (; entry != entries_.end() && entry->low <= box.high[axis_]; ++entry) {
      if (entry->item != item && Meet(boxes[entry->item], box)) {
        pairs->emplace_back(item, entry->item);
      }
    }
  }
}

std::size_t Sweep::bytes() const {
  return entries_.capacity() * sizeof(Entry) + is_known_.capacity();
}

void AllPairs::Update(std::span<const Box3>, std::span<const int> items) {
  for (const int item : items) Know(&is_known_, item);
}

void AllPairs::Remove(int item) { is_known_[item] = 0; }

void AllPairs::FindPairs(std::span<const Box3>, std::span<const int> items,
                         std::vector<std::pair<int, int>>* pairs) {
  for (const int item : items) {
    for (int other = 0; other < static_cast<int>(is_known_.size()); ++other) {
      if (other != item && is_known_[other] != 0) pairs->emplace_back(item, other);
    }
  }
}

std::size_t AllPairs::bytes() const { return is_known_.capacity(); }

}  // namespace touchstone::internal
