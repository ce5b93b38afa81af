#include "core/bsdf/grain_albedo.h"

namespace photopic {

GrainAlbedo::Weights GrainAlbedo::average() const {
  const TablePosition r = place_.roughness(kRoughnesses), g = place_.grain(kGrains);
  Weights weights;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) weights.add(kAverage[r.cell + i][g.cell + j], r.weight(i) * g.weight(j));
  weights.missing = std::exp(weights.missing);
  weights.f0 = 1.0f - weights.missing - weights.f90;
  return weights;
}

}  // namespace photopic
