#pragma once

#include <cstddef>

#include "core/surface.h"

namespace photopic {

/// What a batch of paths goes through; from kStageShade on a stage for each BsdfKind, light sampling and
/// roulette included.
enum Stage : std::size_t {
  kStageBetween,    ///< what lies between the batches: which pixels, estimates of the error
  kStageStart,      ///< sample streams, wavelengths, camera rays
  kStageIntersect,  ///< nearest hits
  kStageEmit,       ///< light of lamps that were hit, absorption, the environment
  kStageSort,       ///< by BSDF
  kStageShadow,
  kStageFilm,
  kStageShade,
  kStages = kStageShade + kBsdfKinds
};

inline Stage shading_stage(BsdfKind kind) {
  return static_cast<Stage>(kStageShade + static_cast<std::size_t>(kind));
}

/// Told when a stage is done with the batch. Most renders have none.
class StageWatch {
 public:
  virtual ~StageWatch() = default;
  virtual void after(Stage stage) = 0;
};

}  // namespace photopic
