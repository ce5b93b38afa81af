#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace photopic {

/// What on the path of a sample was first not finite.
enum class NonFiniteCause : std::uint8_t {
  wavelengths,   ///< the wavelengths drawn, their weights, or an emission spectrum there
  camera,        ///< the ray that leaves the camera
  absorption,    ///< throughput, on the way to a hit
  emission,      ///< light from a lamp or an environment that the path met
  light_sample,  ///< light from a lamp that was sampled
  scattering,    ///< throughput or direction, after a BSDF
  sum,           ///< none of these: the sum over the wavelengths overflows
};
inline constexpr std::size_t kNonFiniteCauses = 7;

/// As told to users.
inline constexpr std::array<std::string_view, kNonFiniteCauses> kNonFiniteCauseNames = {
    "wavelengths", "camera", "absorption", "emission", "light sample", "scattering", "sum"};

/// Samples that were not finite, by cause.
struct NonFiniteCounts {
  std::array<std::uint64_t, kNonFiniteCauses> of{};

  std::uint64_t operator[](NonFiniteCause cause) const { return of[static_cast<std::size_t>(cause)]; }
  std::uint64_t total() const { return std::accumulate(of.begin(), of.end(), std::uint64_t{0}); }
  void add(NonFiniteCause cause) { ++of[static_cast<std::size_t>(cause)]; }
  NonFiniteCounts& operator+=(const NonFiniteCounts& other) {
    for (std::size_t i = 0; i < of.size(); ++i) of[i] += other.of[i];
    return *this;
  }
};

}  // namespace photopic
