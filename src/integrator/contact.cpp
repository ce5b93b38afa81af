#include "integrator/contact.h"

#include <algorithm>
#include <cmath>

#include "core/surface_point.h"

namespace photopic {
namespace {

using Face = Contact::Face;

Face face_of(const PreparedScene& scene, const Hit& hit, Vec3f onwards, float depth) {
  const std::uint32_t material = scene.shapes[hit.shape].material;
  const SurfacePoint point = surface_point(scene.scene.geometry, hit);
  return {hit, {material, dot(point.geometric_normal, onwards) >= 0.0f}, depth, point.error};
}

/// A place while it is being explored. To it belong solids within twice the bound on rounding (the larger of
/// both) of one another, whichever side the ray comes from, and other surfaces within the bound. Paths go on
/// one bound beyond: whether something at the very limit is found or not, it lies on the side of them where
/// they take it to be.
class Place {
 public:
  Place(const PreparedScene& scene, const Hit& hit, const SurfacePoint& point, Vec3f onwards, float way)
      : scene_(scene), hit_(hit), onwards_(onwards), way_(way), error_(point.error) {
    faces_[0] = face_of(scene_, hit_, onwards_, 0.0f), count_ = 1, members_[0] = true;
    if (!touches(scene, hit) || !passes(faces_[0])) return;
    // The ray came from a free place: no further back than half the way there.
    const float back = std::min(bound(hit), 0.5f * way_);
    add_to_extent(faces_[0]);
    for (float reach = 0.0f; reach < reach_ && !overflowed_;) {
      reach = reach_;
      search({point.position - onwards * back, onwards}, back, reach);
      gather();
    }
  }

  Contact contact() {
    Contact c;
    c.met = faces_[0];
    c.overflowed = overflowed_;
    choose_screen(c);
    add_solids(c);
    c.near_end = -std::min(error_ - first_, std::max(0.5f * way_, -first_));
    c.far_end = far_end();
    return c;
  }

 private:
  bool encloses(const Face& f) const { return scene_.surfaces[f.boundary.material].encloses; }
  bool passes(const Face& f) const { return scene_.surfaces[f.boundary.material].lets_through; }
  /// The larger bound of a face and of what touches it [m].
  float bound(const Hit& h) const { return scene_.touching.empty() ? 0.0f : scene_.touching[h.triangle]; }

  void search(const Ray& ray, float back, float reach) {
    std::array<Hit, Contact::kCapacity + 1> found;  // one more tells that there are more
    const std::size_t n = scene_.accel.crossings(ray, back + reach, found);
    overflowed_ = n == found.size();
    count_ = 1;
    for (Hit& h : std::span(found).first(n)) {
      if (h.triangle == hit_.triangle && h.instance == hit_.instance) continue;
      const float depth = h.t - back;
      h.t = hit_.t;
      if (count_ < faces_.size())
        faces_[count_++] = face_of(scene_, h, onwards_, depth);
      else
        overflowed_ = true;
    }
  }

  bool within(const Face& a, const Face& b, float bounds) const {
    return std::abs(a.depth - b.depth) <= bounds * std::max(a.error, b.error);
  }
  bool joins(const Face& f, float bounds) const {
    for (std::size_t i = 0; i < count_; ++i)
      if (members_[i] && within(f, faces_[i], bounds)) return true;
    return false;
  }

  /// The solids that belong to the place, and how far ahead others may.
  void gather() {
    std::fill(members_.begin() + 1, members_.end(), false);
    for (bool grows = true; grows;) {
      grows = false;
      for (std::size_t i = 1; i < count_; ++i)
        if (!members_[i] && encloses(faces_[i]) && joins(faces_[i], 2.0f)) members_[i] = grows = true;
    }
    for (std::size_t i = 0; i < count_; ++i)
      if (members_[i]) add_to_extent(faces_[i]);
  }
  void add_to_extent(const Face& f) {
    error_ = std::max(error_, f.error);
    first_ = std::min(first_, f.depth), last_ = std::max(last_, f.depth);
    reach_ = std::max(reach_, f.depth + 2.0f * std::max(bound(f.hit), f.error));
  }

  /// Of the other surfaces the first that nothing passes, or else the first.
  void choose_screen(Contact& c) {
    for (std::size_t i = 0; i < count_; ++i) {
      const Face& f = faces_[i];
      if (encloses(f) || !(members_[i] || joins(f, 1.0f))) continue;
      const bool better =
          !c.screen || std::pair(passes(f), f.depth) < std::pair(passes(*c.screen), c.screen->depth);
      if (better) c.screen = f;
    }
    if (c.screen) add_to_extent(*c.screen);
  }

  /// By depth; what lies in one depth has the order of the materials.
  void add_solids(Contact& c) {
    for (std::size_t i = 0; i < count_; ++i)
      if (members_[i] && encloses(faces_[i])) c.faces[c.count++] = faces_[i];
    const auto solids = std::span(c.faces).first(c.count);
    std::ranges::sort(solids, {}, &Face::depth);
    for (std::size_t i = 1; i < c.count; ++i)
      for (std::size_t j = i; j > 0 && swapped(solids[j - 1], solids[j]); --j)
        std::swap(solids[j - 1], solids[j]);
    drop_pairs(c);
  }
  bool swapped(const Face& a, const Face& b) const {
    return b.depth - a.depth < error_ && a.boundary.material > b.boundary.material;
  }

  /// Within what rounding leaves of barycentric coordinates: sixteen units in the last place of 1, as in
  /// kPositionError.
  static bool on_edge(const Hit& h) { return std::min({h.u, h.v, 1.0f - h.u - h.v}) < 1e-6f; }

  /// Out of a material and into the same; and twice into it (or out) through one edge.
  static void drop_pairs(Contact& c) {
    for (std::size_t i = 0; i < c.count; ++i)
      for (std::size_t j = i + 1; j < c.count; ++j) {
        const Face &a = c.faces[i], &b = c.faces[j];
        if (a.boundary.material != b.boundary.material) continue;
        const bool same_way = a.boundary.from_inside == b.boundary.from_inside;
        if (same_way && !(on_edge(a.hit) && on_edge(b.hit))) continue;
        erase(c, j);
        if (!same_way) {
          erase(c, i--);
          break;
        }
        --j;
      }
  }
  static void erase(Contact& c, std::size_t i) {
    std::shift_left(c.faces.begin() + static_cast<std::ptrdiff_t>(i),
                    c.faces.begin() + static_cast<std::ptrdiff_t>(c.count), 1);
    --c.count;
  }

  /// No further than half the way to what comes next.
  float far_end() const {
    float free = 2.0f * error_;
    for (std::size_t i = 0; i < count_; ++i)
      if (!members_[i] && faces_[i].depth > last_) free = std::min(free, faces_[i].depth - last_);
    return last_ + 0.5f * free;
  }

  const PreparedScene& scene_;
  const Hit& hit_;
  Vec3f onwards_;
  float way_;                         ///< that the ray came, along the normal [m]
  float error_;                       ///< the largest bound of what belongs to the place [m]
  float first_ = 0.0f, last_ = 0.0f;  ///< its depths [m]
  float reach_ = 0.0f;                ///< depth up to which more may belong to it [m]
  std::array<Face, Contact::kCapacity> faces_;
  std::array<bool, Contact::kCapacity> members_{};
  std::size_t count_ = 0;
  bool overflowed_ = false;
};

}  // namespace

Contact contact_at(const PreparedScene& scene, const Hit& hit, Vec3f direction) {
  const SurfacePoint point = surface_point(scene.scene.geometry, hit);
  const float cosine = dot(point.geometric_normal, direction);
  const Vec3f onwards = cosine < 0.0f ? -point.geometric_normal : point.geometric_normal;
  return Place(scene, hit, point, onwards, std::abs(cosine) * hit.t).contact();
}

}  // namespace photopic
