// SPDX-License-Identifier: Apache-2.0
#include "baseline/uniform_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stoss::client::baseline {
namespace {

/// A few disks spread over a large space need no more cells than this each.
constexpr double kCellsPerDiskMax = 4;

struct Box {
  engine::Vector2 low;
  engine::Vector2 high;
  double radius = 0;
};

Box bounds(std::span<const engine::DiskSpec> disks) {
  Box box{disks.front().position, disks.front().position, 0};
  for (const engine::DiskSpec& disk : disks) {
    box.low = box.low.cwiseMin(disk.position);
    box.high = box.high.cwiseMax(disk.position);
    box.radius = std::max(box.radius, disk.radius);
  }
  return box;
}

}  // namespace

void UniformGrid::build(std::span<const engine::DiskSpec> disks, double margin) {
  rows_ = 0;
  columns_ = 0;
  if (disks.empty()) return;
  const Box box = bounds(disks);
  const engine::Vector2 extent = box.high - box.low;
  double width = 2 * (box.radius + margin);
  if (!extent.allFinite() ||
      !std::isfinite(width)) {  // something has left the range of numbers: one cell for all
    rows_ = columns_ = 1;
    first_ = {0, static_cast<std::uint32_t>(disks.size())};
    members_.resize(disks.size());
    std::iota(members_.begin(), members_.end(), 0U);
    return;
  }
  const double cells_max = kCellsPerDiskMax * static_cast<double>(disks.size());
  while ((std::floor(extent.x() / width) + 1) * (std::floor(extent.y() / width) + 1) > cells_max) {
    width *= 2;
  }
  columns_ = static_cast<std::size_t>(extent.x() / width) + 1;
  rows_ = static_cast<std::size_t>(extent.y() / width) + 1;

  first_.assign(rows_ * columns_ + 1, 0);
  cell_of_.resize(disks.size());
  members_.resize(disks.size());
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const engine::Vector2 offset = (disks[i].position - box.low) / width;
    const std::size_t column = std::min(static_cast<std::size_t>(offset.x()), columns_ - 1);
    const std::size_t row = std::min(static_cast<std::size_t>(offset.y()), rows_ - 1);
    cell_of_[i] = static_cast<std::uint32_t>(row * columns_ + column);
    ++first_[cell_of_[i] + 1];
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < disks.size(); ++i) {
    members_[next[cell_of_[i]]++] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace stoss::client::baseline
