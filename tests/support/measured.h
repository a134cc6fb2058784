// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

/// What verification tests measured, on record: tests/verification/table.py makes a table of it.
namespace berm::tests
{
/// @brief EXPECT_NEAR, put on record in the test's result (gtest's JSON).
/// @param[in] quantity  "S-1 discharge [m2/s]": row of docs/verification.md, quantity, unit if it
///                      has one; no quotes. Said again in one test, the worst counts.
inline void expect_measured(const std::string& quantity, double measured, double reference,
                            double bound)
{
  EXPECT_NEAR(measured, reference, bound) << quantity;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  testing::Test::RecordProperty(
      fmt::format("measured_{}", test->result()->test_property_count()),
      fmt::format(R"({{"quantity":"{}","measured":{},"reference":{},"bound":{}}})", quantity,
                  measured, reference, bound));
}

/// @brief The same for an error, which should be 0.
inline void expect_error(const std::string& quantity, double error, double bound)
{
  expect_measured(quantity, error, 0, bound);
}
} // namespace berm::tests
