#pragma once

#include <type_traits>

#include "core/bsdf/conductor_bsdf.h"
#include "core/bsdf/glass_bsdf.h"
#include "core/bsdf/layered_bsdf.h"
#include "core/bsdf/opaque_bsdf.h"
#include "core/bsdf/spectral_glass_bsdf.h"
#include "core/surface.h"

namespace photopic {

/// Calls f with a std::type_identity of the BSDF of a kind.
template <int N, typename F>
void with_bsdf(BsdfKind kind, const F& f) {
  switch (kind) {
    case BsdfKind::diffuse:
      return f(std::type_identity<DiffuseBsdf<N>>{});
    case BsdfKind::opaque:
      return f(std::type_identity<OpaqueBsdf<N>>{});
    case BsdfKind::conductor:
      return f(std::type_identity<ConductorBsdf<N>>{});
    case BsdfKind::layered:
      return f(std::type_identity<LayeredBsdf<N>>{});
    case BsdfKind::glass:
      return f(std::type_identity<GlassBsdf<N>>{});
    case BsdfKind::spectral_glass:
      return f(std::type_identity<SpectralGlassBsdf<N>>{});
  }
}

}  // namespace photopic
