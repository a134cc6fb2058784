// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "sph/wide.h"

#include <cstdint>
#include <vector>

namespace berm::sph
{
struct Discretisation;

/// The pairs of particles in columns, arranged so that `wide_lanes` particles meet their neighbours
/// with plain loads: no index for each pair, no gather. Points are laid out column by column, in a
/// column from below: images behind the base, particles, free places. A block is `wide_lanes`
/// places of one column, from its lowest particle on. All of a block's neighbours at one distance
/// in this order make an entry; a lane whose particle has no neighbour there has zeros in it.
/// docs/theory.md section 3.
struct Panels
{
  Index places = 0;                ///< points with free places before, between and after them
  Index reach = 0;                 ///< entries touch points of at most this many blocks farther on
  std::vector<Index> place;        ///< of each particle and ghost, shape (n + ghosts)
  std::vector<Index> block;        ///< place of each block's first lane, a multiple of `wide_lanes`
  std::vector<std::int64_t> begin; ///< entries of block b: begin[b] .. begin[b + 1]
  std::vector<Index> offset;       ///< of each entry: place of the neighbour less that of the lane
  std::vector<Wide> G;             ///< gx, gy of each entry [1/m], shape (2 entries)
  std::vector<Wide> viscosity;     ///< s_ij of each entry [m2/s]
};

/// @brief Arrange the pairs of a discretisation of particles that stand in columns.
/// Pure rearrangement: every pair once, zeros elsewhere. Cost O(pairs).
/// @param[in] x, y  Positions of particles and ghosts [m], shape (n + ghosts) each; those of a
///                  column have the same x to the last bit.
[[nodiscard]] Panels arrange_panels(const Discretisation& d, const std::vector<double>& x,
                                    const std::vector<double>& y);
} // namespace berm::sph
