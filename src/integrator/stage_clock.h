#pragma once

#include <array>
#include <ctime>

#include "core/surface.h"

namespace photopic {

/// What a batch of paths spends its time on; from kStageShade on a stage for each BsdfKind, light sampling
/// included.
enum Stage : std::size_t {
  kStageStart,      ///< sample streams, wavelengths, camera rays
  kStageIntersect,  ///< nearest hits
  kStageEmit,       ///< light of lamps that were hit, absorption, the environment
  kStageSort,       ///< by BSDF
  kStageShadow,
  kStageRoulette,
  kStageFilm,
  kStageShade,
  kStages = kStageShade + kBsdfKinds
};

/// Processor seconds of each Stage, of all threads together.
using StageSeconds = std::array<double, kStages>;

/// Tells apart what stages cost, where that is asked for. Stages work on whole batches: looking at the clock
/// between them costs little, not looking nothing.
class StageClock {
 public:
  StageClock(bool on, StageSeconds& seconds) : on_(on), seconds_(seconds) {
    if (on_) last_ = now();
  }

  /// The time since the last stamp was the stage's.
  void stamp(std::size_t stage) {
    if (!on_) return;
    const double time = now();
    seconds_[stage] += time - last_;
    last_ = time;
  }

 private:
  /// The thread's own: what others do on the machine does not count.
  static double now() {
    std::timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  bool on_;
  StageSeconds& seconds_;
  double last_ = 0.0;
};

}  // namespace photopic
