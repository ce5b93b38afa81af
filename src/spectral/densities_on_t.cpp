#include <stdexcept>

#include "spectral/wavelength_distribution.h"

namespace photopic {
namespace {

/// Where the nodes' values stand.
std::vector<double> knots_on_t(std::size_t nodes, bool stepped) {
  const auto cells = static_cast<double>(stepped ? nodes : nodes - 1);
  std::vector<double> t;
  for (std::size_t i = 0; i < nodes; ++i) {
    t.push_back(static_cast<double>(i) / cells);
    if (stepped) t.push_back(static_cast<double>(i + 1) / cells);
  }
  return t;
}

/// Every value twice.
std::vector<double> both_ends(const std::vector<double>& cells) {
  std::vector<double> values;
  for (const double value : cells) values.insert(values.end(), 2, value);
  return values;
}

}  // namespace

std::vector<PiecewiseLinearDensity> densities_on_t(const WavelengthDistribution& distribution) {
  if (distribution.components.empty())
    throw std::invalid_argument("a wavelength distribution has no densities");
  const std::size_t nodes = distribution.components[0].nodes.size();
  if (nodes < (distribution.stepped ? 1u : 2u)) throw std::invalid_argument("a density has too few nodes");
  const std::vector<double> t = knots_on_t(nodes, distribution.stepped);

  std::vector<PiecewiseLinearDensity> densities;
  for (const auto& component : distribution.components) {
    if (component.nodes.size() != nodes)
      throw std::invalid_argument("the densities differ in their number of nodes");
    densities.emplace_back(t, distribution.stepped ? both_ends(component.nodes) : component.nodes);
  }
  return densities;
}

}  // namespace photopic
