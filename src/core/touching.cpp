#include "core/touching.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>

#include "core/accel.h"
#include "core/framing.h"
#include "core/surface_point.h"

namespace photopic {
namespace {

/// What may lie within that many bounds on rounding of a face counts as touching it: integrator/contact.cpp
/// looks two ahead.
constexpr float kReach = 3.0f;

/// The sine from which planes are far from each other but along the line where they cross.
constexpr double kSteep = 0.1;

using Corners = std::array<Vec3f, 3>;

/// A triangle in the world.
struct Item {
  Boxf box;  ///< grown by the reach
  std::uint32_t triangle, instance;
};

Corners corners_of(const Geometry& geometry, std::uint32_t triangle, std::uint32_t instance) {
  Corners c;
  for (std::size_t k = 0; k < 3; ++k) {
    c[k] = geometry.positions[geometry.triangles[triangle][k]];
    if (instance != kNoInstance) c[k] = geometry.instances[instance].to_world.point(c[k]);
  }
  return c;
}

float error_of(const Geometry& geometry, const Corners& c, std::uint32_t instance) {
  return instance == kNoInstance ? position_error(c[0], c[1], c[2]) : geometry.instances[instance].error;
}

Item item_of(const Geometry& geometry, std::uint32_t triangle, std::uint32_t instance) {
  const Corners c = corners_of(geometry, triangle, instance);
  Item item{{}, triangle, instance};
  for (const Vec3f& p : c) item.box.add(p);
  item.box.grow(kReach * error_of(geometry, c, instance));
  return item;
}

Vec3d unit_normal(const Corners& c) {
  const Vec3d a = to_double(c[0]), n = cross(to_double(c[1]) - a, to_double(c[2]) - a);
  return dot(n, n) > 0.0 ? normalize(n) : n;
}

/// Whether all of b but what it shares with a lies off a's plane, on one side.
bool plane_separates(const Corners& a, Vec3d normal, const Corners& b, double reach) {
  int above = 0, below = 0, shared = 0;
  for (const Vec3f& p : b) {
    const double h = dot(normal, to_double(p) - to_double(a[0]));
    if (std::ranges::find(a, p) != a.end())
      ++shared;
    else if (h > reach)
      ++above;
    else if (h < -reach)
      ++below;
  }
  return shared < 3 && (above + shared == 3 || below + shared == 3);
}

/// Whether b lies beside a, seen along a's normal.
bool edge_separates(const Corners& a, Vec3d normal, const Corners& b, double reach) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d from = to_double(a[k]), along = to_double(a[(k + 1) % 3]) - from;
    const Vec3d out = cross(along, normal);
    const double least = -reach * length(out);
    if (std::ranges::all_of(b, [&](Vec3f p) { return dot(out, to_double(p) - from) >= least; })) return true;
  }
  return false;
}

bool touch(const Corners& a, const Corners& b, double reach) {
  const Vec3d na = unit_normal(a), nb = unit_normal(b);
  if (length(cross(na, nb)) > kSteep) return false;
  if (dot(na, na) == 0.0 || dot(nb, nb) == 0.0) return false;  // without area
  return !plane_separates(a, na, b, reach) && !plane_separates(b, nb, a, reach) &&
         !edge_separates(a, na, b, reach) && !edge_separates(b, nb, a, reach);
}

/// Finds pairs: a tree of the solids' boxes, joined with itself and with what else there is.
class Search {
 public:
  Search(const Geometry& geometry, std::vector<Item> solids)
      : geometry_(geometry),
        items_(std::move(solids)),
        bounds_(geometry.triangles.size()),
        root_(build(0, items_.size())) {}

  void join_solids() { within(*root_); }

  /// What is not solid. Threads may ask at once.
  void join(const Item& other) { against(*root_, other); }

  /// Whether a solid may touch what is in that box.
  bool is_near(const Boxf& box) const { return is_near(*root_, box); }

  std::vector<float> take() && {
    if (!any_) bounds_.clear();
    return std::move(bounds_);
  }

 private:
  struct Node {
    Boxf box;
    std::size_t begin, end;
    std::unique_ptr<Node> left, right;  ///< both or none
  };
  static constexpr std::size_t kLeaf = 8, kForTwo = 10000;

  template <typename First, typename Second>
  static void both(bool parallel, const First& first, const Second& second) {
    if (parallel)
      tbb::parallel_invoke(first, second);
    else
      first(), second();
  }

  std::unique_ptr<Node> build(std::size_t begin, std::size_t end) {
    auto node = std::make_unique<Node>(Node{{}, begin, end, nullptr, nullptr});
    for (std::size_t i = begin; i < end; ++i) node->box.add(items_[i].box);
    if (end - begin <= kLeaf) return node;
    const Vec3f size = node->box.high - node->box.low;
    const auto axis = size.x >= size.y && size.x >= size.z ? &Vec3f::x
                      : size.y >= size.z                   ? &Vec3f::y
                                                           : &Vec3f::z;
    const auto middle = [&](const Item& i) { return i.box.low.*axis + i.box.high.*axis; };
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::ranges::nth_element(at(begin), at(half), at(end), {}, middle);
    both(
        end - begin > kForTwo, [&] { node->left = build(begin, half); },
        [&] { node->right = build(half, end); });
    return node;
  }

  void within(const Node& n) {
    if (!n.left) {
      for (std::size_t i = n.begin; i < n.end; ++i)
        for (std::size_t j = i + 1; j < n.end; ++j) compare(items_[i], items_[j]);
      return;
    }
    both(
        n.end - n.begin > kForTwo, [&] { within(*n.left); },
        [&] { within(*n.right), between(*n.left, *n.right); });
  }

  void between(const Node& a, const Node& b) {
    if (!a.box.overlaps(b.box)) return;
    if (!a.left && !b.left) {
      for (std::size_t i = a.begin; i < a.end; ++i)
        for (std::size_t j = b.begin; j < b.end; ++j) compare(items_[i], items_[j]);
    } else if (!b.left || (a.left && a.end - a.begin >= b.end - b.begin)) {
      between(*a.left, b), between(*a.right, b);
    } else {
      between(a, *b.left), between(a, *b.right);
    }
  }

  void against(const Node& n, const Item& other) {
    if (!n.box.overlaps(other.box)) return;
    if (n.left) return against(*n.left, other), against(*n.right, other);
    for (std::size_t i = n.begin; i < n.end; ++i) compare(items_[i], other);
  }

  bool is_near(const Node& n, const Boxf& box) const {
    if (!n.box.overlaps(box)) return false;
    if (n.left) return is_near(*n.left, box) || is_near(*n.right, box);
    const auto items = std::span(items_).subspan(n.begin, n.end - n.begin);
    return std::ranges::any_of(items, [&](const Item& i) { return i.box.overlaps(box); });
  }

  void compare(const Item& a, const Item& b) {
    if (!a.box.overlaps(b.box)) return;
    const Corners ca = corners_of(geometry_, a.triangle, a.instance),
                  cb = corners_of(geometry_, b.triangle, b.instance);
    const float error = std::max(error_of(geometry_, ca, a.instance), error_of(geometry_, cb, b.instance));
    if (touch(ca, cb, kReach * error)) mark(a, error), mark(b, error);
  }

  void mark(const Item& i, float error) {
    const std::atomic_ref bound(bounds_[i.triangle]);
    float last = bound.load(std::memory_order_relaxed);
    while (last < error && !bound.compare_exchange_weak(last, error, std::memory_order_relaxed)) continue;
    any_.store(true, std::memory_order_relaxed);
  }

  const Geometry& geometry_;
  std::vector<Item> items_;
  std::vector<float> bounds_;
  std::unique_ptr<const Node> root_;
  std::atomic<bool> any_ = false;
};

std::span<const Shape> baked_shapes(const Geometry& geometry) {
  return std::span(geometry.shapes).first(geometry.baked_shape_count());
}

std::span<const Shape> shapes_of(const Geometry& geometry, const Prototype& prototype) {
  return std::span(geometry.shapes).subspan(prototype.first_shape, prototype.shape_count);
}

std::vector<Item> list_solids(const Geometry& geometry, std::span<const Surface> surfaces) {
  std::vector<Item> items;
  const auto add = [&](std::span<const Shape> shapes, std::uint32_t instance) {
    for (const Shape& shape : shapes)
      for (std::uint32_t i = 0; surfaces[shape.material].encloses && i < shape.triangle_count; ++i)
        items.push_back(item_of(geometry, shape.first_triangle + i, instance));
  };
  add(baked_shapes(geometry), kNoInstance);
  for (std::uint32_t i = 0; i < geometry.instances.size(); ++i)
    add(shapes_of(geometry, geometry.prototypes[geometry.instances[i].prototype]), i);
  return items;
}

/// Around what is not solid of a prototype, in its own space.
Boxf box_of_others(const Geometry& geometry, std::span<const Surface> surfaces, const Prototype& prototype) {
  Boxf box;
  for (const Shape& shape : shapes_of(geometry, prototype))
    if (!surfaces[shape.material].encloses) box.add(box_of(geometry, shape));
  return box;
}

/// Instances far from all solids, most where there are many, cost no more than a look at their boxes.
void join_others(const Geometry& geometry, std::span<const Surface> surfaces, Search& search) {
  const auto join = [&](std::span<const Shape> shapes, std::uint32_t instance) {
    for (const Shape& shape : shapes)
      if (!surfaces[shape.material].encloses)
        tbb::parallel_for(shape.first_triangle, shape.first_triangle + shape.triangle_count,
                          [&](std::uint32_t t) { search.join(item_of(geometry, t, instance)); });
  };
  join(baked_shapes(geometry), kNoInstance);
  std::vector<Boxf> boxes;
  for (const Prototype& p : geometry.prototypes) boxes.push_back(box_of_others(geometry, surfaces, p));
  tbb::parallel_for(std::size_t{0}, geometry.instances.size(), [&](std::size_t i) {
    const Instance& instance = geometry.instances[i];
    Boxf box = image_of(boxes[instance.prototype], instance.to_world);
    box.grow((kReach + 2.0f) * instance.error);  // its corners and those of what it holds are rounded
    if (search.is_near(box))
      join(shapes_of(geometry, geometry.prototypes[instance.prototype]), static_cast<std::uint32_t>(i));
  });
}

}  // namespace

std::vector<float> touching_triangles(const Geometry& geometry, std::span<const Surface> surfaces) {
  std::vector<Item> solids = list_solids(geometry, surfaces);
  if (solids.empty()) return {};
  Search search(geometry, std::move(solids));
  search.join_solids();
  join_others(geometry, surfaces, search);
  return std::move(search).take();
}

bool touches(const Shape& shape, std::span<const float> touching) {
  if (touching.empty()) return false;
  const auto its = touching.subspan(shape.first_triangle, shape.triangle_count);
  return std::ranges::any_of(its, [](float error) { return error > 0.0f; });
}

bool is_free_pane(const Shape& shape, const Surface& surface, std::span<const float> touching) {
  return surface.is_pane && !touches(shape, touching);
}

}  // namespace photopic
