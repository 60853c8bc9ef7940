// SPDX-License-Identifier: Apache-2.0
#pragma once

// A dynamic bounding-volume tree over boxes of any size, anywhere: no world size, no cell size, and
// a wall a thousand times longer than a disk is one leaf.
//
// Source: surface-area-guided insertion and rotation-free refitting after Catto, "Dynamic Bounding
// Volume Hierarchies", GDC 2019; height balance by AVL rotations.
//
// Invariants: 1. every inner node has two children and the union of their boxes; 2. a leaf keeps
// its number while its item is in; 3. heights of siblings differ by at most one after balance().

#include "broad_phase/aabb.hpp"

#include <cstdint>
#include <vector>

namespace stoss::engine {

class AabbTree {
 public:
  /// Puts `item` in with `box`; returns its leaf. REQUIRES: not in the tree.
  std::int32_t insert(std::int32_t item, const Aabb& box);
  /// Takes the item of a leaf out.
  void remove(std::int32_t leaf);
  const Aabb& box_of(std::int32_t leaf) const { return nodes_[index(leaf)].box; }

  /// Calls visit(item) for every item whose box overlaps `box`.
  template <class Visit>
  void query(const Aabb& box, Visit&& visit) const {
    if (root_ == kNull) return;
    std::int32_t stack[kDepthMax];
    int depth = 0;
    stack[depth++] = root_;
    while (depth > 0) {
      const Node& node = nodes_[index(stack[--depth])];
      if (!overlaps(node.box, box)) continue;
      if (node.is_leaf()) {
        visit(node.item);
      } else {
        stack[depth++] = node.child[0];
        stack[depth++] = node.child[1];
      }
    }
  }

 private:
  static constexpr std::int32_t kNull = -1;
  /// Deeper than any balanced tree of 2^31 leaves (1.44 * 31), and one sibling a level.
  static constexpr int kDepthMax = 64;

  struct Node {
    Aabb box;
    std::int32_t parent = kNull;
    std::int32_t child[2] = {kNull, kNull};
    std::int32_t item = kNull;
    std::int32_t height = 0;
    bool is_leaf() const { return child[0] == kNull; }
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  Node& node(std::int32_t i) { return nodes_[index(i)]; }
  std::int32_t allocate();
  std::int32_t best_sibling(const Aabb& box) const;
  void refit_upwards(std::int32_t from);
  void refit(std::int32_t i);
  std::int32_t balance(std::int32_t i);
  std::int32_t rotate_up(std::int32_t i, int side);
  void replace_child(std::int32_t parent, std::int32_t old_child, std::int32_t new_child);

  std::vector<Node> nodes_;
  std::vector<std::int32_t> free_;
  std::int32_t root_ = kNull;
};

}  // namespace stoss::engine
