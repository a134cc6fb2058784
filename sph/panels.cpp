// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/panels.h"

#include "sph/discretisation.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace berm::sph
{
namespace
{
constexpr Index lanes = static_cast<Index>(wide_lanes);

Index round_up(Index place)
{
  return (place + lanes - 1) / lanes * lanes;
}

/// Give every point its place and cut the columns into blocks.
void lay_out(Panels& p, Index n, const std::vector<double>& x, const std::vector<double>& y)
{
  std::vector<Index> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [](const std::vector<double>& v, Index i)
  { return v[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(),
            [&](Index i, Index j)
            { return at(x, i) != at(x, j) ? at(x, i) < at(x, j) : at(y, i) < at(y, j); });

  p.place.resize(x.size());
  Index next = 0;
  for (auto column = order.begin(); column != order.end();)
  {
    const auto end =
        std::find_if(column, order.end(), [&](Index i) { return at(x, i) != at(x, *column); });
    const auto soil = std::find_if(column, end, [n](Index i) { return i < n; });
    const auto below = static_cast<Index>(soil - column);
    const Index first = round_up(next + below); // of the soil; of images alone: past them
    for (auto i = column; i != end; ++i)
      p.place[static_cast<std::size_t>(*i)] = first - below + static_cast<Index>(i - column);
    next = first + static_cast<Index>(end - soil);
    for (Index block = first; block < next; block += lanes)
      p.block.push_back(block);
    next = round_up(next);
    column = end;
  }
  p.places = next;
}
} // namespace

Panels arrange_panels(const Discretisation& d, const std::vector<double>& x,
                      const std::vector<double>& y)
{
  Panels p;
  lay_out(p, d.n, x, y);

  // Step 1: the entries of each block, and each pair in its lane.
  p.begin.push_back(0);
  Index i = 0; // the particles stand in the order of their places
  std::vector<Index> offsets;
  for (const Index first : p.block)
  {
    const Index i_begin = i;
    while (i < d.n && p.place[static_cast<std::size_t>(i)] < first + lanes)
      ++i;
    const auto pairs = [&](const auto& what)
    {
      for (Index a = i_begin; a < i; ++a)
      {
        const Index place = p.place[static_cast<std::size_t>(a)];
        assert(place >= first);
        const auto row = static_cast<std::size_t>(a);
        for (auto k = static_cast<std::size_t>(d.neighbours.begin[row]);
             k < static_cast<std::size_t>(d.neighbours.begin[row + 1]); ++k)
          what(k, p.place[static_cast<std::size_t>(d.neighbours.index[k])] - place,
               static_cast<std::size_t>(place - first));
      }
    };
    offsets.clear();
    pairs([&](std::size_t, Index offset, std::size_t) { offsets.push_back(offset); });
    std::sort(offsets.begin(), offsets.end());
    offsets.erase(std::unique(offsets.begin(), offsets.end()), offsets.end());

    const std::size_t entries = p.offset.size();
    p.offset.insert(p.offset.end(), offsets.begin(), offsets.end());
    p.G.resize(2 * p.offset.size());
    p.viscosity.resize(p.offset.size());
    pairs(
        [&](std::size_t k, Index offset, std::size_t lane)
        {
          const std::size_t e =
              entries +
              static_cast<std::size_t>(std::lower_bound(offsets.begin(), offsets.end(), offset) -
                                       offsets.begin());
          p.G[2 * e][lane] = d.G[k][0];
          p.G[2 * e + 1][lane] = d.G[k][1];
          p.viscosity[e][lane] = d.viscosity[k];
        });
    p.begin.push_back(static_cast<std::int64_t>(p.offset.size()));
  }
  assert(i == d.n);

  // Step 2: free places before and after, so that lanes without a neighbour have something to load.
  const auto [lowest, highest] = std::minmax_element(p.offset.begin(), p.offset.end());
  const Index margin = p.offset.empty() ? 0 : round_up(std::max(-*lowest, *highest));
  for (Index& place : p.place)
    place += margin;
  for (Index& first : p.block)
    first += margin;
  p.places += 2 * margin;

  // Step 3: how far entries reach, through images to the particles that move them.
  std::vector<Index> owner(static_cast<std::size_t>(p.places), -1);
  const auto block_of = [&](Index particle)
  {
    const Index place = p.place[static_cast<std::size_t>(particle)];
    return static_cast<Index>(std::upper_bound(p.block.begin(), p.block.end(), place) -
                              p.block.begin() - 1);
  };
  for (Index a = 0; a < d.n; ++a)
    owner[static_cast<std::size_t>(p.place[static_cast<std::size_t>(a)])] = block_of(a);
  for (std::size_t g = 0; g < d.ghosts.size(); ++g)
    owner[static_cast<std::size_t>(p.place[static_cast<std::size_t>(d.n) + g])] =
        block_of(d.ghosts[g].source);
  for (std::size_t b = 0; b < p.block.size(); ++b)
    for (auto e = static_cast<std::size_t>(p.begin[b]);
         e < static_cast<std::size_t>(p.begin[b + 1]); ++e)
      for (Index l = 0; l < lanes; ++l)
        if (const Index o = owner[static_cast<std::size_t>(p.block[b] + l + p.offset[e])]; o >= 0)
          p.reach = std::max(p.reach, std::abs(o - static_cast<Index>(b)));
  return p;
}
} // namespace berm::sph
