// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/kernel.h"

#include <gtest/gtest.h>

namespace berm::sph
{
TEST(CubicSpline, IntegratesToOneOverThePlane)
{
  const CubicSpline W{0.6};
  const int n = 4000;
  const double dr = W.radius() / n;
  double integral = 0;
  for (int k = 0; k < n; ++k)
  {
    const double r = (k + 0.5) * dr;
    integral += W.W(r) * 2 * pi * r * dr;
  }
  EXPECT_NEAR(integral, 1, 1e-6); // midpoint rule, error O(1/n^2)
}

TEST(CubicSpline, DerivativeIsThatOfTheKernel)
{
  const CubicSpline W{0.6};
  const double step = 1e-6;
  for (const double r : {0.05, 0.3, 0.59, 0.61, 0.9, 1.19})
    EXPECT_NEAR(W.dW(r), (W.W(r + step) - W.W(r - step)) / (2 * step), 1e-7) << "r = " << r;
}

TEST(CubicSpline, VanishesSmoothlyAtTheEndOfItsSupport)
{
  const CubicSpline W{0.6};
  EXPECT_EQ(W.W(1.2), 0);
  EXPECT_EQ(W.dW(1.2), 0);
  EXPECT_NEAR(W.W(1.2 - 1e-4), 0, 1e-11);
  EXPECT_EQ(W.dW(0), 0);
}
} // namespace berm::sph
