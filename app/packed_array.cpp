// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/packed_array.h"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace berm::app
{
namespace
{
std::string compressed(std::string_view bytes)
{
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib cannot compress an array");
  out.resize(size);
  return out;
}

/// Differences of successive codes, all lowest bytes first, then all of the next, and so on:
/// neighbours are alike, so that the high bytes are nearly all equal and cost next to nothing.
template <typename Code>
std::string data_text(const std::vector<Code>& codes)
{
  std::string bytes(codes.size() * sizeof(Code), '\0');
  Code last = 0;
  for (std::size_t i = 0; i < codes.size(); ++i)
  {
    const auto difference = static_cast<Code>(codes[i] - last);
    last = codes[i];
    for (std::size_t b = 0; b < sizeof(Code); ++b)
      bytes[b * codes.size() + i] = static_cast<char>((difference >> (8 * b)) & 0xff);
  }
  return base64(compressed(bytes));
}
} // namespace

Json packed(std::span<const double> values)
{
  const auto [low, high] = std::ranges::minmax_element(values);
  const double least = values.empty() ? 0 : *low;
  const double step = values.empty() ? 0 : (*high - least) / 65535;
  std::vector<std::uint16_t> codes(values.size());
  for (std::size_t i = 0; i < values.size() && step > 0; ++i)
    codes[i] = static_cast<std::uint16_t>(
        std::clamp(std::round((values[i] - least) / step), 0.0, 65535.0));
  return {{"bits", 16},
          {"count", values.size()},
          {"least", least},
          {"step", step},
          {"data", data_text(codes)}};
}

Json packed_column(std::span<const double> rows, std::size_t first, std::size_t stride)
{
  std::vector<double> column;
  column.reserve(rows.size() / stride);
  for (std::size_t i = first; i < rows.size(); i += stride)
    column.push_back(rows[i]);
  return packed(column);
}

Json packed_whole(std::span<const std::uint32_t> values)
{
  return {{"bits", 32},
          {"count", values.size()},
          {"data", data_text(std::vector<std::uint32_t>(values.begin(), values.end()))}};
}

std::string base64(std::string_view bytes)
{
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0'); // EVP ends it with a zero
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                  reinterpret_cast<const unsigned char*>(bytes.data()),
                  static_cast<int>(bytes.size()));
  text.pop_back();
  return text;
}

std::string sha256(std::string_view bytes)
{
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("OpenSSL has no SHA-256");
  return {reinterpret_cast<const char*>(digest.data()), size};
}

std::string hexadecimal(std::string_view bytes)
{
  std::string text;
  for (const char c : bytes)
    fmt::format_to(std::back_inserter(text), "{:02x}", static_cast<unsigned char>(c));
  return text;
}
} // namespace berm::app
