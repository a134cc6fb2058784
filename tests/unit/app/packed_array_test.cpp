// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/packed_array.h"

#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <cmath>
#include <numeric>

namespace berm::app::test
{
namespace
{
/// The bytes behind a packed array's text: base64, then zlib.
std::vector<unsigned char> bytes_of(const Json& packed)
{
  const std::string text = packed.at("data");
  std::vector<unsigned char> coded(text.size());
  EVP_DecodeBlock(coded.data(), reinterpret_cast<const unsigned char*>(text.data()),
                  static_cast<int>(text.size()));
  std::vector<unsigned char> bytes(packed.at("count").get<std::size_t>() *
                                   packed.at("bits").get<std::size_t>() / 8);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &size, coded.data(), coded.size()), Z_OK);
  EXPECT_EQ(size, bytes.size());
  return bytes;
}

/// Codes from differences whose bytes lie in planes, lowest first.
std::vector<std::uint32_t> codes_of(const Json& packed)
{
  const std::vector<unsigned char> bytes = bytes_of(packed);
  const std::size_t n = packed.at("count"), planes = packed.at("bits").get<std::size_t>() / 8;
  std::vector<std::uint32_t> codes(n);
  std::uint32_t code = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t b = 0; b < planes; ++b)
      code += static_cast<std::uint32_t>(bytes[b * n + i]) << (8 * b);
    codes[i] = planes == 2 ? code & 0xffff : code;
  }
  return codes;
}
} // namespace

TEST(PackedArray, NumbersComeBackWithinHalfAStep)
{
  std::vector<double> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = -3e5 + 7e5 * std::sin(0.37 * static_cast<double>(i * i));
  const Json json = packed(values);
  const auto codes = codes_of(json);
  const double least = json.at("least"), step = json.at("step");
  EXPECT_LE(step, 1.4e6 / 65535);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(least + step * codes[i], values[i], 0.5001 * step);
}

TEST(PackedArray, EqualNumbersAndNoneAtAllAreExact)
{
  const Json equal = packed(std::vector<double>{4.25, 4.25, 4.25});
  EXPECT_EQ(equal.at("least"), 4.25);
  EXPECT_EQ(equal.at("step"), 0.0);
  EXPECT_EQ(codes_of(equal), (std::vector<std::uint32_t>{0, 0, 0}));
  EXPECT_EQ(packed({}).at("count"), 0);
}

TEST(PackedArray, AColumnIsEveryStridethNumber)
{
  const std::vector<double> rows = {1, 10, 2, 20, 3, 30};
  EXPECT_EQ(packed_column(rows, 1, 2), packed(std::vector<double>{10, 20, 30}));
}

TEST(PackedArray, WholeNumbersAreExact)
{
  const std::vector<std::uint32_t> values = {0, 4294967295U, 5, 70000, 69999};
  EXPECT_EQ(codes_of(packed_whole(values)), values);
}

TEST(PackedArray, NeighboursThatAreAlikeTakeLittleRoom)
{
  std::vector<std::uint32_t> values(10000);
  std::iota(values.begin(), values.end(), 0U);
  EXPECT_LT(packed_whole(values).at("data").get<std::string>().size(), 400U); // of 40 000 bytes
}

TEST(PackedArray, Base64AndSha256AreThoseOfTheStandards)
{
  // RFC 4648, section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  // FIPS 180-4, the one-block example.
  EXPECT_EQ(hexadecimal(sha256("abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}
} // namespace berm::app::test
