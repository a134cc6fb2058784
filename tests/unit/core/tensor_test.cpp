// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tensor.h"

#include <gtest/gtest.h>

namespace berm
{
TEST(Tensor, InvariantsOfPrincipalStressesAreTheirTextbookValues)
{
  const SymTensor sig{.xx = -30, .yy = -60, .zz = -90, .xy = 0};
  EXPECT_DOUBLE_EQ(I1(sig), -180);
  // J2 = ((s1-s2)^2 + (s2-s3)^2 + (s3-s1)^2) / 6
  EXPECT_DOUBLE_EQ(J2(sig), (30. * 30 + 30. * 30 + 60. * 60) / 6);
}

TEST(Tensor, CompressionIsNegativeStressAndPositivePorePressure)
{
  // Ten metres of water: sigma = sigma' - p_w I with sigma' = 0 is compression, hence negative.
  const double p_w = 10 * water_unit_weight;
  const SymTensor effective{}, total = effective + (-p_w) * SymTensor{1, 1, 1, 0};
  EXPECT_LT(I1(total), 0);
  EXPECT_DOUBLE_EQ(total.yy, -98100);
  EXPECT_DOUBLE_EQ(J2(total), 0); // pore pressure shears nothing
}

TEST(Tensor, InvariantsDoNotChangeWithTheFrame)
{
  const double a = 0.7, c = std::cos(a), s = std::sin(a);
  const SymTensor sig{.xx = 3, .yy = -5, .zz = 2, .xy = 4};
  const SymTensor turned{.xx = c * c * sig.xx + s * s * sig.yy + 2 * s * c * sig.xy,
                         .yy = s * s * sig.xx + c * c * sig.yy - 2 * s * c * sig.xy,
                         .zz = sig.zz,
                         .xy = (c * c - s * s) * sig.xy + s * c * (sig.yy - sig.xx)};
  EXPECT_NEAR(I1(turned), I1(sig), 1e-14);
  EXPECT_NEAR(J2(turned), J2(sig), 1e-13);
}
} // namespace berm
