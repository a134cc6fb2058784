// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/neighbours.h"

#include <gtest/gtest.h>
#include <random>

namespace berm::sph
{
namespace
{
struct Cloud
{
  std::vector<double> x, y;
};

Cloud random_cloud(std::size_t n, double width, double height)
{
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> unit(0, 1);
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i)
  {
    cloud.x.push_back(-3 + width * unit(engine));
    cloud.y.push_back(5 + height * unit(engine));
  }
  return cloud;
}
} // namespace

TEST(Neighbours, AreThoseOfBruteForceInOrder)
{
  for (const auto& [width, height, radius] :
       {std::tuple{10., 10., 0.7}, {10., 10., 3.3}, {50., 0.5, 1.}, {1., 1., 5.}})
  {
    const Cloud c = random_cloud(600, width, height);
    const NeighbourList list = find_neighbours(c.x, c.y, 500, radius);
    ASSERT_EQ(list.begin.size(), 501u);
    for (Index i = 0; i < 500; ++i)
    {
      std::vector<Index> expected;
      for (Index j = 0; j < 600; ++j)
        if (j != i && std::hypot(c.x[std::size_t(i)] - c.x[std::size_t(j)],
                                 c.y[std::size_t(i)] - c.y[std::size_t(j)]) < radius)
          expected.push_back(j);
      const auto found = list.of(i);
      EXPECT_EQ(std::vector<Index>(found.begin(), found.end()), expected) << "point " << i;
    }
  }
}

TEST(Neighbours, OfNothingAreNone)
{
  const NeighbourList list = find_neighbours({}, {}, 0, 1);
  EXPECT_EQ(list.begin.size(), 1u);
  EXPECT_TRUE(list.index.empty());
}
} // namespace berm::sph
