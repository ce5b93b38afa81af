#include "core/gltf/skin.h"

#include <fmt/format.h>

#include "core/gltf/nodes.h"

namespace photopic {
namespace {

std::array<float, 4> components(const Vec4f& v) {
  return {v.x, v.y, v.z, v.w};
}

Affine operator*(const Affine& a, double s) {
  return {a.x * s, a.y * s, a.z * s, a.t * s};
}
Affine operator+(const Affine& a, const Affine& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z, a.t + b.t};
}

}  // namespace

Affine SkinPoses::to_world(int node) {
  const std::size_t count = document_.model.nodes.size();
  if (parent_.empty()) {
    parent_.assign(count, -1);
    world_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      for (const int child : document_.model.nodes[i].children)
        parent_[static_cast<std::size_t>(child)] = static_cast<int>(i);
  }
  // Up to a node that is known, then down again.
  std::vector<int> path;
  for (; node >= 0 && !world_[static_cast<std::size_t>(node)]; node = parent_[static_cast<std::size_t>(node)])
    path.push_back(node);
  Affine world = node >= 0 ? *world_[static_cast<std::size_t>(node)] : Affine{};
  for (auto step = path.rbegin(); step != path.rend(); ++step) {
    world = world * local_transform(document_, *step);
    world_[static_cast<std::size_t>(*step)] = world;
  }
  return world;
}

const std::vector<Affine>& SkinPoses::joint_matrices(int index) {
  const tinygltf::Skin& skin = document_.model.skins[index];
  matrices_.resize(document_.model.skins.size());
  std::vector<Affine>& matrices = matrices_[static_cast<std::size_t>(index)];
  if (!matrices.empty()) return matrices;

  std::vector<Mat4f> bind;
  if (skin.inverseBindMatrices >= 0) bind = read_elements<Mat4f>(document_, skin.inverseBindMatrices);
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    Affine matrix = to_world(skin.joints[j]);
    if (!bind.empty()) {
      const Mat4f& m = bind[j];
      matrix =
          matrix * Affine{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    if (!is_finite(matrix))
      document_.fail(fmt::format("/skins/{}", index), fmt::format("joint {} is not at a finite place", j));
    matrices.push_back(matrix);
  }
  return matrices;
}

std::vector<Affine> SkinPoses::vertex_transforms(int skin, const PrimitiveRef& ref) {
  const std::vector<Affine>& matrices = joint_matrices(skin);
  std::vector<Affine> transforms;
  std::vector<float> total;
  for (int set = 0;; ++set) {  // four joints each
    const std::string joints_name = fmt::format("JOINTS_{}", set),
                      weights_name = fmt::format("WEIGHTS_{}", set);
    const auto joints = read_attribute<Vec4f>(document_, ref, joints_name.c_str());
    const auto weights = read_attribute<Vec4f>(document_, ref, weights_name.c_str());
    if (joints.empty() || weights.empty()) break;
    transforms.resize(joints.size(), Affine{} * 0.0);
    total.resize(joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const float weight = components(weights[i])[k], joint = components(joints[i])[k];
        if (!(weight > 0)) continue;
        if (!(joint >= 0 && joint < static_cast<float>(matrices.size())))
          document_.fail(
              ref.pointer() + "/attributes/" + joints_name,
              fmt::format("joint {} of vertex {} lies beyond the skin's {}", joint, i, matrices.size()));
        transforms[i] = transforms[i] + matrices[static_cast<std::size_t>(joint)] * weight;
        total[i] += weight;
      }
    }
  }
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    if (total[i] == 0.0f)
      document_.fail(ref.pointer() + "/attributes/WEIGHTS_0",
                     fmt::format("the weights of vertex {} are all 0", i));
    transforms[i] = transforms[i] * (1.0 / total[i]);
  }
  return transforms;
}

}  // namespace photopic
