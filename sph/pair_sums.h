// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/discretisation.h"
#include "sph/lanes.h"
#include "sph/panels.h"
#include "sph/wide.h"

#include <algorithm>
#include <array>
#include <vector>

/// The sums over pairs of the total-Lagrangian form, block by block of `wide_lanes` particles, and
/// the velocities and stresses that they read: from panels where there are some, from the list of
/// neighbours for any other packing. Both have the same members, so that TotalLagrangian is written
/// once; both sum a lane in an order that depends on nothing but the packing.
namespace berm::sph
{
/// Over the pairs of a block, with G_ij of eq. (3.2).
struct BlockGradient
{
  Wide xx = {}, xy = {}, yx = {}, yy = {}; ///< sum_j (v_j - v_i) (x) G_ij [1/s]
  Wide fx = {}, fy = {};                   ///< viscous acceleration, eq. (3.9) [m/s2]
};
struct BlockVector
{
  Wide x = {}, y = {};
};
/// T = sigma' B of eq. (3.5) [Pa].
struct BlockTensor
{
  Wide xx = {}, xy = {}, yx = {}, yy = {};
};

/// A value in every place.
class PlaceField
{
public:
  explicit PlaceField(Index places = 0) : values_(static_cast<std::size_t>(places) / wide_lanes) {}
  /// Lanes from any place on.
  [[nodiscard]] Wide at(Index place) const
  {
    return load_wide(reinterpret_cast<const double*>(values_.data()) + place);
  }
  void set(Index place, const Wide& v)
  {
    values_[static_cast<std::size_t>(place) / wide_lanes] = v;
  }
  void set(Index place, double v)
  {
    std::memcpy(reinterpret_cast<char*>(values_.data()) +
                    static_cast<std::size_t>(place) * sizeof v,
                &v, sizeof v);
  }

private:
  std::vector<Wide> values_; ///< aligned
};

/// Over panels.
class PanelSums
{
public:
  explicit PanelSums(const Discretisation& d)
      : p_(d.panels), vx_(p_.places), vy_(p_.places), Txx_(p_.places), Txy_(p_.places),
        Tyx_(p_.places), Tyy_(p_.places)
  {
  }
  [[nodiscard]] Index blocks() const { return static_cast<Index>(p_.block.size()); }
  [[nodiscard]] Index reach() const { return p_.reach; }
  /// Where a particle or ghost keeps its values.
  [[nodiscard]] Index point(std::size_t i) const { return p_.place[i]; }
  /// Block times `wide_lanes` plus lane of each particle.
  [[nodiscard]] std::vector<Index> lanes(Index n) const
  {
    std::vector<Index> lanes(static_cast<std::size_t>(n));
    std::size_t b = 0;
    for (std::size_t i = 0; i < lanes.size(); ++i)
    {
      while (p_.place[i] >= p_.block[b] + static_cast<Index>(wide_lanes))
        ++b;
      lanes[i] = static_cast<Index>(b * wide_lanes) + p_.place[i] - p_.block[b];
    }
    return lanes;
  }

  [[nodiscard]] BlockVector velocity(std::size_t b) const
  {
    return {vx_.at(p_.block[b]), vy_.at(p_.block[b])};
  }
  void set_velocity(std::size_t b, const BlockVector& v)
  {
    vx_.set(p_.block[b], v.x);
    vy_.set(p_.block[b], v.y);
  }
  void set_velocity_of_point(Index point, double vx, double vy)
  {
    vx_.set(point, vx);
    vy_.set(point, vy);
  }
  void set_T(std::size_t b, const BlockTensor& T)
  {
    Txx_.set(p_.block[b], T.xx);
    Txy_.set(p_.block[b], T.xy);
    Tyx_.set(p_.block[b], T.yx);
    Tyy_.set(p_.block[b], T.yy);
  }
  void set_T_of_point(Index point, double xx, double xy, double yx, double yy)
  {
    Txx_.set(point, xx);
    Txy_.set(point, xy);
    Tyx_.set(point, yx);
    Tyy_.set(point, yy);
  }

  [[nodiscard]] BlockGradient gradient(std::size_t b) const
  {
    const Index i = p_.block[b];
    const Wide vx_i = vx_.at(i), vy_i = vy_.at(i);
    BlockGradient s;
    for (auto e = static_cast<std::size_t>(p_.begin[b]);
         e < static_cast<std::size_t>(p_.begin[b + 1]); ++e)
    {
      const Index j = i + p_.offset[e];
      const Wide gx = p_.G[2 * e], gy = p_.G[2 * e + 1];
      const Wide dvx = vx_.at(j) - vx_i, dvy = vy_.at(j) - vy_i;
      const Wide xx = dvx * gx, yy = dvy * gy;
      s.xx += xx;
      s.xy += dvx * gy;
      s.yx += dvy * gx;
      s.yy += yy;
      const Wide approach = p_.viscosity[e] * (xx + yy);
      s.fx += approach * gx;
      s.fy += approach * gy;
    }
    return s;
  }
  /// sum_j (T_i + T_j) G_ij [Pa/m]
  [[nodiscard]] BlockVector divergence(std::size_t b) const
  {
    const Index i = p_.block[b];
    const Wide xx = Txx_.at(i), xy = Txy_.at(i), yx = Tyx_.at(i), yy = Tyy_.at(i);
    BlockVector s;
    for (auto e = static_cast<std::size_t>(p_.begin[b]);
         e < static_cast<std::size_t>(p_.begin[b + 1]); ++e)
    {
      const Index j = i + p_.offset[e];
      const Wide gx = p_.G[2 * e], gy = p_.G[2 * e + 1];
      s.x += (Txx_.at(j) + xx) * gx + (Txy_.at(j) + xy) * gy;
      s.y += (Tyx_.at(j) + yx) * gx + (Tyy_.at(j) + yy) * gy;
    }
    return s;
  }

private:
  const Panels& p_;
  PlaceField vx_, vy_, Txx_, Txy_, Tyx_, Tyy_;
};

/// Over the list of neighbours, one particle after the other.
class ListSums
{
public:
  explicit ListSums(const Discretisation& d)
      : d_(d), n_(static_cast<std::size_t>(d.n)), v_(n_ + d.ghosts.size()), T_(v_.size())
  {
  }
  [[nodiscard]] Index blocks() const
  {
    return static_cast<Index>((n_ + wide_lanes - 1) / wide_lanes);
  }
  [[nodiscard]] Index reach() const
  {
    const auto lanes = static_cast<Index>(wide_lanes);
    Index reach = 0;
    for (Index i = 0; i < d_.n; ++i)
      for (const Index j : d_.neighbours.of(i))
      {
        const Index source = j < d_.n ? j : d_.ghosts[static_cast<std::size_t>(j - d_.n)].source;
        reach = std::max(reach, std::abs(source / lanes - i / lanes));
      }
    return reach;
  }
  [[nodiscard]] Index point(std::size_t i) const { return static_cast<Index>(i); }
  [[nodiscard]] std::vector<Index> lanes(Index n) const
  {
    std::vector<Index> lanes(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < lanes.size(); ++i)
      lanes[i] = static_cast<Index>(i);
    return lanes;
  }

  [[nodiscard]] BlockVector velocity(std::size_t b) const
  {
    BlockVector v;
    for_lanes(b,
              [&](std::size_t i, std::size_t l)
              {
                v.x[l] = v_[i][0];
                v.y[l] = v_[i][2];
              });
    return v;
  }
  void set_velocity(std::size_t b, const BlockVector& v)
  {
    for_lanes(b,
              [&](std::size_t i, std::size_t l) {
                v_[i] = Lanes{v.x[l], v.x[l], v.y[l], v.y[l]};
              });
  }
  void set_velocity_of_point(Index point, double vx, double vy)
  {
    v_[static_cast<std::size_t>(point)] = Lanes{vx, vx, vy, vy};
  }
  void set_T(std::size_t b, const BlockTensor& T)
  {
    for_lanes(b,
              [&](std::size_t i, std::size_t l) {
                T_[i] = Lanes{T.xx[l], T.xy[l], T.yx[l], T.yy[l]};
              });
  }
  void set_T_of_point(Index point, double xx, double xy, double yx, double yy)
  {
    T_[static_cast<std::size_t>(point)] = Lanes{xx, xy, yx, yy};
  }

  [[nodiscard]] BlockGradient gradient(std::size_t b) const
  {
    std::array<std::array<double, wide_lanes>, 6> s{};
    for_lanes(b,
              [&](std::size_t i, std::size_t l)
              {
                const Lanes v_i = v_[i];
                Lanes L = {0, 0, 0, 0}, f = {0, 0, 0, 0};
                for_pairs(i,
                          [&](std::size_t k, std::size_t j)
                          {
                            const double gx = d_.G[k][0], gy = d_.G[k][1];
                            const Lanes G = {gx, gy, gx, gy};
                            const Lanes product = (v_[j] - v_i) * G;
                            L += product;
                            f += (d_.viscosity[k] * (product[0] + product[3])) * G;
                          });
                for (std::size_t c = 0; c < 4; ++c)
                  s[c][l] = L[c];
                s[4][l] = f[0];
                s[5][l] = f[1];
              });
    return {load_wide(s[0].data()), load_wide(s[1].data()), load_wide(s[2].data()),
            load_wide(s[3].data()), load_wide(s[4].data()), load_wide(s[5].data())};
  }
  [[nodiscard]] BlockVector divergence(std::size_t b) const
  {
    std::array<std::array<double, wide_lanes>, 2> s{};
    for_lanes(b,
              [&](std::size_t i, std::size_t l)
              {
                const Lanes T_i = T_[i];
                Lanes f = {0, 0, 0, 0};
                for_pairs(i,
                          [&](std::size_t k, std::size_t j)
                          {
                            const double gx = d_.G[k][0], gy = d_.G[k][1];
                            f += (T_[j] + T_i) * Lanes{gx, gy, gx, gy};
                          });
                s[0][l] = f[0] + f[1];
                s[1][l] = f[2] + f[3];
              });
    return {load_wide(s[0].data()), load_wide(s[1].data())};
  }

private:
  /// Every particle of a block and its lane; the last block is not full.
  template <class What>
  void for_lanes(std::size_t b, const What& what) const
  {
    const std::size_t end = std::min(wide_lanes, n_ - b * wide_lanes);
    for (std::size_t l = 0; l < end; ++l)
      what(b * wide_lanes + l, l);
  }
  template <class What>
  void for_pairs(std::size_t i, const What& what) const
  {
    const auto end = static_cast<std::size_t>(d_.neighbours.begin[i + 1]);
    for (auto k = static_cast<std::size_t>(d_.neighbours.begin[i]); k < end; ++k)
      what(k, static_cast<std::size_t>(d_.neighbours.index[k]));
  }

  const Discretisation& d_;
  std::size_t n_;
  std::vector<Lanes> v_; ///< {vx, vx, vy, vy} of particles and ghosts [m/s]
  std::vector<Lanes> T_; ///< {xx, xy, yx, yy} of particles and ghosts [Pa]
};
} // namespace berm::sph
