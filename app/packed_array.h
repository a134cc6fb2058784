// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Arrays as text that a page can hold: few digits, differences, zlib, base64.
namespace berm::app
{
/// @brief Numbers in 16 bits each: value = least + step * code.
/// What is read back is off by at most half a step, a 131 070th of the range.
/// @param[in] values  Finite. Any length.
[[nodiscard]] Json packed(std::span<const double> values);

/// @brief Every `stride`-th of the values, from `first` on, likewise: a column of rows.
[[nodiscard]] Json packed_column(std::span<const double> rows, std::size_t first,
                                 std::size_t stride);

/// @brief Whole numbers >= 0, exactly, in 32 bits each.
[[nodiscard]] Json packed_whole(std::span<const std::uint32_t> values);

/// @brief Base64 (RFC 4648, with padding, without line ends).
[[nodiscard]] std::string base64(std::string_view bytes);

/// @brief SHA-256, 32 bytes.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// @brief Bytes as hexadecimal digits, in lower case.
[[nodiscard]] std::string hexadecimal(std::string_view bytes);
} // namespace berm::app
