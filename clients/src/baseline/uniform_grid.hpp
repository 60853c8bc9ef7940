// SPDX-License-Identifier: Apache-2.0
#pragma once

// Which disks may touch: those in the same or in adjacent cells of a uniform grid whose cells are
// at least as wide as the largest disk. Made anew at every step by counting sort.

#include <stoss/engine/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stoss::client::baseline {

class UniformGrid {
 public:
  /// Sorts the disks into cells that are wide enough for disks that are larger by `margin` (m).
  void build(std::span<const engine::DiskSpec> disks, double margin = 0);

  /// Calls `visit(i, j)`, i < j, once for every two disks of the same or of adjacent cells, in an
  /// order that depends on the positions alone.
  template <class F>
  void for_each_pair(F&& visit) const {
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column) {
        within(row, column, visit);
        // Half of the eight neighbours; the other half is visited from their side.
        if (column + 1 < columns_) between(row, column, row, column + 1, visit);
        if (row + 1 >= rows_) continue;
        if (column > 0) between(row, column, row + 1, column - 1, visit);
        between(row, column, row + 1, column, visit);
        if (column + 1 < columns_) between(row, column, row + 1, column + 1, visit);
      }
    }
  }

 private:
  [[nodiscard]] std::span<const std::uint32_t> cell(std::size_t row, std::size_t column) const {
    const std::size_t at = row * columns_ + column;
    return std::span(members_).subspan(first_[at], first_[at + 1] - first_[at]);
  }

  template <class F>
  void within(std::size_t row, std::size_t column, F& visit) const {
    const auto members = cell(row, column);
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) visit(members[i], members[j]);
    }
  }

  template <class F>
  void between(std::size_t row,
               std::size_t column,
               std::size_t other_row,
               std::size_t other_column,
               F& visit) const {
    for (const std::uint32_t a : cell(row, column)) {
      for (const std::uint32_t b : cell(other_row, other_column)) {
        if (a < b) {
          visit(a, b);
        } else {
          visit(b, a);
        }
      }
    }
  }

  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<std::uint32_t> cell_of_;
  std::vector<std::uint32_t> first_;    ///< of each cell, in members_; one more than cells
  std::vector<std::uint32_t> members_;  ///< disks by cell, in order within each
};

}  // namespace stoss::client::baseline
