// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/strength_reduction.h"
#include "sph/trial.h"

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Trials and settled soil as bytes, to send or keep them: for one program on one kind of machine.
namespace berm::sph
{
class ByteWriter
{
public:
  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void put(const Value& value)
  {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// Strings and vectors of plain values: length, then content.
  template <class List>
  requires std::is_trivially_copyable_v<typename List::value_type>
  void put(const List& list)
  {
    put(list.size());
    bytes_.append(reinterpret_cast<const char*>(list.data()),
                  list.size() * sizeof(typename List::value_type));
  }
  [[nodiscard]] std::string bytes() { return std::move(bytes_); }

private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote, in the same order.
class ByteReader
{
public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void get(Value& value) { take(&value, 1, sizeof value); }
  template <class List>
  requires std::is_trivially_copyable_v<typename List::value_type>
  void get(List& list)
  {
    std::size_t size = 0;
    get(size);
    if (size > rest_.size()) // before memory is asked for
      cut_short();
    list.resize(size);
    take(list.data(), size, sizeof(typename List::value_type));
  }

private:
  void take(void* to, std::size_t count, std::size_t each)
  {
    if (count > rest_.size() / each)
      cut_short();
    if (count > 0)
      std::memcpy(to, rest_.data(), count * each);
    rest_.remove_prefix(count * each);
  }
  [[noreturn]] static void cut_short() { throw std::length_error("bytes are missing"); }

  std::string_view rest_;
};

void write(ByteWriter& bytes, const Trial& trial);
void read(ByteReader& bytes, Trial& trial);
void write(ByteWriter& bytes, const Settled& settled);
void read(ByteReader& bytes, Settled& settled);

template <class Work>
[[nodiscard]] std::string to_bytes(const Work& work)
{
  ByteWriter bytes;
  write(bytes, work);
  return bytes.bytes();
}

/// @param[in] text  As `to_bytes` of the same Work made it.
/// @throws std::length_error if it is too short.
template <class Work>
[[nodiscard]] Work from_bytes(const std::string& text)
{
  ByteReader bytes(text);
  Work work;
  read(bytes, work);
  return work;
}
} // namespace berm::sph
