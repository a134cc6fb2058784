// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/panels.h"

#include "sph/discretisation.h"
#include "sph/fill.h"
#include "sph/wavefront.h"
#include "sph/wide_soil.h"
#include "tests/support/sections.h"

#include <array>
#include <gtest/gtest.h>
#include <map>
#include <omp.h>
#include <random>
#include <utility>

namespace berm::sph
{
namespace
{
/// The embankment with a vertical step in its ground and a sloping base: columns of many heights.
meshes::Section stepped_section()
{
  meshes::SectionInput input = tests::embankment();
  input.ground.insert(input.ground.begin() + 1, {{10, 7.3}, {10, 12}, {20, 12}, {20, 7.3}});
  input.base = {{0, 0}, {191.4, 3}};
  return meshes::build_section(input);
}

/// Every pair of a discretisation with its gradient and viscosity.
using Pairs = std::map<std::pair<Index, Index>, std::array<double, 3>>;

Pairs listed(const Discretisation& d)
{
  Pairs pairs;
  for (Index i = 0; i < d.n; ++i)
    for (auto k = std::size_t(d.neighbours.begin[std::size_t(i)]);
         k < std::size_t(d.neighbours.begin[std::size_t(i) + 1]); ++k)
      pairs[{i, d.neighbours.index[k]}] = {d.G[k][0], d.G[k][1], d.viscosity[k]};
  return pairs;
}
} // namespace

TEST(Panels, HoldEveryPairOnceAndZerosElsewhere)
{
  for (const double dx : {2.0, 1.3})
  {
    const meshes::Section section = stepped_section();
    Particles particles = fill(section, dx, "columns");
    tests::set_density(particles, 2000);
    const Discretisation d = discretise(particles, std::vector{tests::embankment_soil()},
                                        std::vector<double>(particles.size(), 0.0), section);
    const Panels& p = d.panels;
    ASSERT_FALSE(p.block.empty());

    std::map<Index, Index> point_at; // by place
    for (std::size_t i = 0; i < p.place.size(); ++i)
      EXPECT_TRUE(point_at.emplace(p.place[i], Index(i)).second) << "two points in one place";
    Pairs pairs;
    for (std::size_t b = 0; b < p.block.size(); ++b)
      for (auto e = std::size_t(p.begin[b]); e < std::size_t(p.begin[b + 1]); ++e)
        for (std::size_t l = 0; l < wide_lanes; ++l)
        {
          const Index place = p.block[b] + Index(l), beside = place + p.offset[e];
          ASSERT_GE(beside, 0);
          ASSERT_LT(beside, p.places);
          const std::array<double, 3> pair = {p.G[2 * e][l], p.G[2 * e + 1][l], p.viscosity[e][l]};
          if (pair == std::array<double, 3>{})
            continue;
          EXPECT_TRUE(
              pairs.emplace(std::pair{point_at.at(place), point_at.at(beside)}, pair).second)
              << "a pair twice";
        }
    EXPECT_EQ(pairs, listed(d));
  }
}

TEST(Panels, LoadNoBlockBeyondTheirReach)
{
  const meshes::Section section = stepped_section();
  Particles particles = fill(section, 1.3, "columns");
  tests::set_density(particles, 2000);
  const Discretisation d = discretise(particles, std::vector{tests::embankment_soil()},
                                      std::vector<double>(particles.size(), 0.0), section);
  const Panels& p = d.panels;
  std::map<Index, Index> owner; // block that writes a place
  for (std::size_t b = 0; b < p.block.size(); ++b)
    for (std::size_t l = 0; l < wide_lanes; ++l)
      owner[p.block[b] + Index(l)] = Index(b);
  std::map<Index, Index> image_owner;
  for (std::size_t g = 0; g < d.ghosts.size(); ++g)
    image_owner[p.place[std::size_t(d.n) + g]] = owner.at(p.place[std::size_t(d.ghosts[g].source)]);
  owner.insert(image_owner.begin(), image_owner.end());

  Index farthest = 0;
  for (std::size_t b = 0; b < p.block.size(); ++b)
    for (auto e = std::size_t(p.begin[b]); e < std::size_t(p.begin[b + 1]); ++e)
      for (std::size_t l = 0; l < wide_lanes; ++l)
        if (const auto o = owner.find(p.block[b] + Index(l) + p.offset[e]); o != owner.end())
          farthest = std::max(farthest, std::abs(o->second - Index(b)));
  EXPECT_LE(farthest, p.reach);
  EXPECT_LT(p.reach, Index(p.block.size()) / 8) << "nothing left to take several passes at a time";
}

TEST(Wavefront, GivesEachBlockWhatPassesOneByOneWouldGive)
{
  // Two fields; each pass writes one of them from the other one's values within the reach. Integers
  // that overflow: any value taken too early or too late shows.
  constexpr Index blocks = 97, reach = 9;
  constexpr long passes = 23;
  using Fields = std::array<std::vector<unsigned>, 2>;
  const auto start = []
  {
    Fields f = {std::vector<unsigned>(blocks, 1), std::vector<unsigned>(blocks, 2)};
    for (std::size_t b = 0; b < blocks; ++b)
      f[0][b] += 7 * unsigned(b);
    return f;
  };
  const auto take = [](Fields& f, long pass, std::size_t b)
  {
    const auto& from = f[std::size_t(pass % 2)];
    unsigned& to = f[std::size_t((pass + 1) % 2)][b];
    const std::size_t end = std::min<std::size_t>(blocks, b + reach + 1);
    for (std::size_t j = b < reach ? 0 : b - reach; j < end; ++j)
      to = 31 * to + from[j];
  };
  Fields expected = start();
  for (long pass = 0; pass < 2 * passes; ++pass)
    for (std::size_t b = 0; b < blocks; ++b)
      take(expected, pass % passes, b);

  const int threads_before = omp_get_max_threads();
  for (const int threads : {1, 2, 5})
    for (const long depth : {1L, 2L, 8L, 100L})
    {
      omp_set_num_threads(threads);
      Wavefront wavefront(blocks, reach, depth);
      Fields f = start();
      for (int run = 0; run < 2; ++run)
        wavefront.run(passes,
                      [&](long pass, std::size_t begin, std::size_t end)
                      {
                        for (std::size_t b = begin; b < end; ++b)
                          take(f, pass, b);
                      });
      EXPECT_EQ(f, expected) << threads << " threads, " << depth << " passes at a time";
    }
  omp_set_num_threads(threads_before);
}

TEST(WideSoil, ReturnsEveryLaneAsTheScalarFormDoes)
{
  const Elastic e = elastic_moduli(1e8, 0.3);
  Cone cut = fit_plane_strain(10e3, 0.5, 0.2);
  cut.most_tension = 3e3;
  const std::array<Cone, 6> cones = {fit_plane_strain(10e3, 0.5, 0),
                                     fit_plane_strain(10e3, 0.5, 0.5),
                                     fit_plane_strain(20e3, 0, 0), // alpha = 0: no apex
                                     fit_plane_strain(0, 0.6, 0.1),
                                     cut,
                                     Cone{.k = 1e300}};
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::array<int, 4> seen{}; // elastic, smooth, apex, cut-off
  for (int trial = 0; trial < 20000; ++trial)
  {
    WideSoil soil;
    WideStress sig;
    std::array<SymTensor, wide_lanes> before;
    std::array<Cone, wide_lanes> cone;
    for (std::size_t l = 0; l < wide_lanes; ++l)
    {
      cone[l] = cones[std::size_t(engine() % cones.size())];
      soil.set(l, e, cone[l]);
      const double p = 5e4 * uniform(engine), s = trial % 10 == 0 ? 0 : 2e4;
      before[l] = {p + s * uniform(engine), p + s * uniform(engine), p + s * uniform(engine),
                   s * uniform(engine)};
      sig.xx[l] = before[l].xx;
      sig.yy[l] = before[l].yy;
      sig.zz[l] = before[l].zz;
      sig.xy[l] = before[l].xy;
    }
    const Wide strain = return_to_cone(sig, soil);
    for (std::size_t l = 0; l < wide_lanes; ++l)
    {
      const Returned exact = return_to_cone(before[l], cone[l], e);
      const double rounding = 1e-14 * 1e5; // some ten roundings of stresses below 1e5 Pa
      EXPECT_NEAR(sig.xx[l], exact.sig.xx, rounding);
      EXPECT_NEAR(sig.yy[l], exact.sig.yy, rounding);
      EXPECT_NEAR(sig.zz[l], exact.sig.zz, rounding);
      EXPECT_NEAR(sig.xy[l], exact.sig.xy, rounding);
      EXPECT_NEAR(strain[l], exact.plastic_strain, rounding / e.G);
      ++seen[I1(before[l]) > cone[l].most_tension                ? 3
             : exact.sig.xx == before[l].xx                      ? 0
             : exact.sig.xx == exact.sig.yy && exact.sig.xy == 0 ? 2
                                                                 : 1];
    }
  }
  for (const int count : seen)
    EXPECT_GT(count, 100);
}
} // namespace berm::sph
