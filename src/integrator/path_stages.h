#pragma once

#include <span>

#include "core/compiled_sampler.h"
#include "integrator/features.h"
#include "integrator/integrator.h"
#include "integrator/non_finite_watch.h"
#include "integrator/path_batch.h"
#include "integrator/shading_stage.h"

namespace photopic {

/// Advances batches of paths from the camera to their ends, one stage for all of them at a time.
/// kHas must cover the scene.
template <int N, Features kHas>
class PathTracer {
 public:
  /// @param sampler of the scene's emissions
  PathTracer(const PreparedScene& scene, const CompiledSampler& sampler, const RenderOptions& options);

  /// Traces the paths and adds them to the film in the order given. At most options.batch_size of them.
  void trace(std::span<const PathKey> paths, Film& film);

  const RenderStats& stats() const { return stats_; }

 private:
  void done(Stage stage) {
    if (watch_) watch_->after(stage);
  }
  const ShapeTraits& traits_at(std::uint32_t slot) const { return scene_.shapes[batch_.hits[slot].shape]; }
  bool has_media() const { return kHas.media && !batch_.media.empty(); }
  /// Every stage of the paths, up to what each has gathered.
  void advance(std::span<const PathKey> paths);
  void start(std::span<const PathKey> paths);
  void draw_wavelengths(const Packet& packet, UintLanes bits);
  void leave_camera(const Packet& packet, const RayLanes& rays);
  void intersect(bool coherent);
  void escape();
  void absorb_and_emit();
  bool travel(std::uint32_t slot);
  void pass_hidden_surfaces();
  bool is_hidden_lamp(std::uint32_t slot) const;
  BsdfKind choose_kind(std::uint32_t slot, int depth) const;
  void sort_by_bsdf(int depth);
  void prefetch_texels();
  void trace_shadow_rays(int depth);
  void dim_by_panes(std::uint32_t slot, int depth);
  float flight(std::uint32_t slot) const;
  /// A path whose last ray could not be traced is lost, whatever it had gathered.
  bool is_lost(std::size_t slot) const { return !is_traceable(batch_.rays[slot]); }
  void finish(std::span<const PathKey> paths, Film& film);
  void count_non_finite(std::span<const PathKey> paths);

  const PreparedScene& scene_;
  const CompiledSampler& sampler_;
  const RenderOptions& options_;
  PathBatch<N> batch_;
  ShadingStage<N, kHas> shading_;
  PathMedia camera_media_;  ///< around the camera
  bool hides_lamps_;        ///< some lamp may lie unseen in glass
  RenderStats stats_;
  StageWatch* watch_ = options_.watch;  ///< or none
};

}  // namespace photopic
