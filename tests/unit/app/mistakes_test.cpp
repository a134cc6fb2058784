// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/mistakes.h"

#include <gtest/gtest.h>

namespace berm::app
{
TEST(Mistakes, AreToldInTheFilesOrderWithPlaceValueAllowedAndHint)
{
  KeyPlaces places;
  places.set("", "a.toml", 0);
  places.set("soil.fill", "a.toml:5", 5);
  places.set("soil.fill.phi", "a.toml:7", 7);
  const std::string text =
      describe({{.key = "soil.fill.phi", .value = "95", .allowed = "0 <= phi < 90"},
                {.key = "soil.fill.c", .problem = std::string(missing_key)},
                {.key = "soil.x", .problem = std::string(unknown_key), .hint = "did you mean y?"}},
               places);
  EXPECT_EQ(text, "a.toml: unknown key soil.x\n"
                  "  hint: did you mean y?\n"
                  "a.toml:5: missing key soil.fill.c\n"
                  "a.toml:7: soil.fill.phi = 95\n"
                  "  allowed: 0 <= phi < 90\n"
                  "3 mistakes; nothing was run.\n");
}

TEST(Mistakes, OneIsNotCalledMany)
{
  const std::string text = describe({{.key = "a", .problem = "is wrong"}}, {});
  EXPECT_EQ(text, "a: is wrong\n1 mistake; nothing was run.\n");
}

TEST(Mistakes, ThatAStageFindsDoNotClaimThatNothingWasRun)
{
  KeyPlaces places;
  places.run_began = true;
  EXPECT_EQ(describe({{.key = "a", .problem = "is wrong"}}, places),
            "a: is wrong\n1 mistake; the run was given up.\n");
}

TEST(Mistakes, NeverPassAControlCharacterToTheTerminal)
{
  const std::string text = describe({{.key = "a\x1b[31m", .value = "b\x07", .problem = "c"}}, {});
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\x07'), std::string::npos);
}

TEST(Mistakes, NearestFindsTyposEndingsAndUnits)
{
  const std::vector<std::string_view> known = {"cohesion_kPa", "friction_angle_deg", "title",
                                               "spacing_m"};
  EXPECT_EQ(nearest("cohesion_Pa", known), "cohesion_kPa");
  EXPECT_EQ(nearest("cohesion", known), "cohesion_kPa");
  EXPECT_EQ(nearest("friction_angle_rad", known), "friction_angle_deg");
  EXPECT_EQ(nearest("Title", known), "title");
  EXPECT_EQ(nearest("titel", known), "title");
  EXPECT_EQ(nearest("viscosity", known), "");
  EXPECT_EQ(nearest("", known), "");
  EXPECT_EQ(nearest(std::string(100000, 'x'), known), "");
}
} // namespace berm::app
