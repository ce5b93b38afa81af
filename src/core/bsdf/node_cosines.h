#pragma once

#include "core/bsdf/albedo_axes.h"
#include "core/bsdf/fresnel_albedo.h"

namespace photopic {

/// An axis of cos θ for tables of FresnelAlbedo::Weights: fourth roots up to the first node of the rest, from
/// there on equal steps that meet every node, where the weights of smooth surfaces have kinks.
struct NodeCosines {
  int near_horizon;  ///< steps below the first node
  int per_node;      ///< steps between two nodes

  constexpr int size() const { return near_horizon + FresnelAlbedo::kNodes * per_node + 1; }

  float operator[](int i) const {
    const float first = FresnelAlbedo::node(0);
    if (i <= near_horizon) return first * albedo_cosine(i, near_horizon + 1);
    return first * (1.0f + static_cast<float>(i - near_horizon) / static_cast<float>(per_node));
  }

  TablePosition locate(float cos_theta) const {
    const float nodes = cos_theta * (FresnelAlbedo::kNodes + 1);
    if (nodes < 1.0f) return locate_cosine(nodes, near_horizon + 1);
    TablePosition place =
        photopic::locate((nodes - 1.0f) / FresnelAlbedo::kNodes, FresnelAlbedo::kNodes * per_node + 1);
    place.cell += near_horizon;
    return place;
  }
};

}  // namespace photopic
