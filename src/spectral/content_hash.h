#pragma once

#include <cmath>
#include <cstdint>
#include <string>

namespace photopic {

/// FNV-1a (64 bit; Fowler, Noll, Vo), the same on every machine: names contents in files, guards nothing.
class ContentHash {
 public:
  void add_byte(std::uint64_t byte) { hash_ = (hash_ ^ (byte & 0xffu)) * 0x100000001b3u; }
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) add_byte(word >> (8 * byte));
  }
  /// A number rounded to a resolution. The golden section keeps simple fractions away from the rounding's
  /// edge, where one ulp would decide. @param number / resolution within ±2⁶³
  void add(double number, double resolution) {
    add(static_cast<std::uint64_t>(
        static_cast<std::int64_t>(std::floor(number / resolution + 0.6180339887498949))));
  }

  /// 16 hex digits.
  std::string text() const {
    std::string text(16, '0');
    for (int digit = 0; digit < 16; ++digit)
      text[static_cast<std::size_t>(digit)] = "0123456789abcdef"[(hash_ >> (60 - 4 * digit)) & 15];
    return text;
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace photopic
