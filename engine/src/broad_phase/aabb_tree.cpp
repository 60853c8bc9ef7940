// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/aabb_tree.hpp"

#include <algorithm>

namespace stoss::engine {

std::int32_t AabbTree::allocate() {
  if (free_.empty()) {
    nodes_.emplace_back();
    return static_cast<std::int32_t>(nodes_.size()) - 1;
  }
  const std::int32_t i = free_.back();
  free_.pop_back();
  node(i) = Node{};
  return i;
}

void AabbTree::replace_child(std::int32_t parent, std::int32_t old_child, std::int32_t new_child) {
  node(new_child).parent = parent;
  if (parent == kNull) {
    root_ = new_child;
  } else {
    Node& p = node(parent);
    p.child[p.child[0] == old_child ? 0 : 1] = new_child;
  }
}

// Descends into the child whose box grows least, until staying is cheaper than going on.
std::int32_t AabbTree::best_sibling(const Aabb& box) const {
  std::int32_t i = root_;
  while (!nodes_[index(i)].is_leaf()) {
    const Node& here = nodes_[index(i)];
    const double combined = extent(merged(here.box, box));
    const double stay = 2 * combined;
    const double inherited = 2 * (combined - extent(here.box));
    double descend[2];
    for (int side = 0; side < 2; ++side) {
      const Node& child = nodes_[index(here.child[side])];
      const double grown_by = extent(merged(child.box, box));
      descend[side] = inherited + (child.is_leaf() ? grown_by : grown_by - extent(child.box));
    }
    if (stay < descend[0] && stay < descend[1]) break;
    i = here.child[descend[0] < descend[1] ? 0 : 1];
  }
  return i;
}

std::int32_t AabbTree::insert(std::int32_t item, const Aabb& box) {
  const std::int32_t leaf = allocate();
  node(leaf).box = box;
  node(leaf).item = item;
  if (root_ == kNull) {
    root_ = leaf;
    return leaf;
  }
  const std::int32_t sibling = best_sibling(box);
  const std::int32_t joint = allocate();
  replace_child(node(sibling).parent, sibling, joint);
  node(joint).child[0] = sibling;
  node(joint).child[1] = leaf;
  node(sibling).parent = joint;
  node(leaf).parent = joint;
  refit_upwards(joint);
  return leaf;
}

void AabbTree::remove(std::int32_t leaf) {
  const std::int32_t joint = node(leaf).parent;
  free_.push_back(leaf);
  if (joint == kNull) {
    root_ = kNull;
    return;
  }
  const std::int32_t sibling = node(joint).child[node(joint).child[0] == leaf ? 1 : 0];
  const std::int32_t above = node(joint).parent;
  replace_child(above, joint, sibling);
  free_.push_back(joint);
  refit_upwards(above);
}

void AabbTree::refit(std::int32_t i) {
  Node& here = node(i);
  const Node& a = node(here.child[0]);
  const Node& b = node(here.child[1]);
  here.box = merged(a.box, b.box);
  here.height = 1 + std::max(a.height, b.height);
}

void AabbTree::refit_upwards(std::int32_t from) {
  for (std::int32_t i = from; i != kNull; i = node(i).parent) {
    refit(i);
    i = balance(i);
  }
}

// Returns the node that now stands where `i` stood.
std::int32_t AabbTree::balance(std::int32_t i) {
  const std::int32_t lean = node(node(i).child[1]).height - node(node(i).child[0]).height;
  if (lean > 1) return rotate_up(i, 1);
  if (lean < -1) return rotate_up(i, 0);
  return i;
}

// The child on `side` takes the place of `i`, and `i` adopts the lower of its children.
std::int32_t AabbTree::rotate_up(std::int32_t i, int side) {
  const std::int32_t up = node(i).child[side];
  const int high = node(node(up).child[0]).height > node(node(up).child[1]).height ? 0 : 1;
  const std::int32_t adopted = node(up).child[1 - high];
  replace_child(node(i).parent, i, up);
  node(up).child[1 - high] = i;
  node(i).parent = up;
  node(i).child[side] = adopted;
  node(adopted).parent = i;
  refit(i);
  refit(up);
  return up;
}

}  // namespace stoss::engine
