#include "optimize/density_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace photopic {

DensityModel::DensityModel(std::vector<bool> backwards, int nodes, int strata)
    : backwards_(std::move(backwards)), nodes_(nodes), strata_(strata), width_(1.0 / (nodes - 1)) {
  const std::size_t count = backwards_.size();
  a_.resize(count * nodes_);
  total_.resize(count);
  sum_.resize(nodes_);
  samples_.resize(count * strata_);
  pull_.resize(count * nodes_);
  by_total_.resize(count);
  by_sum_.resize(nodes_);
}

void DensityModel::draw(std::span<const double> v) {
  std::transform(v.begin(), v.end(), a_.begin(), [](double x) { return std::exp(x); });

  // Each density's integral, and the sum of the normalised ones.
  std::fill(sum_.begin(), sum_.end(), 0.0);
  for (int k = 0; k < wavelengths(); ++k) {
    const double* a = &a_[k * nodes_];
    total_[k] = 0.0;
    for (int b = 0; b < nodes_; ++b) total_[k] += hat(b) * a[b];
    for (int b = 0; b < nodes_; ++b) sum_[b] += a[b] / total_[k];
  }
  for (int k = 0; k < wavelengths(); ++k) draw_density(k);

  std::fill(pull_.begin(), pull_.end(), Pull{});
  std::fill(by_total_.begin(), by_total_.end(), 0.0);
  std::fill(by_sum_.begin(), by_sum_.end(), 0.0);
}

void DensityModel::draw_density(int wavelength) {
  const double* a = &a_[wavelength * nodes_];
  const double total = total_[wavelength];
  int cell = 0;
  double reached = 0.0, mass = 0.5 * width_ * (a[0] + a[1]);
  for (int i = 0; i < strata_; ++i) {
    // The strata are in order, so the cells are met one after the other.
    const double u = (i + 0.5) / strata_;
    while (cell + 2 < nodes_ && reached + mass <= u * total) {
      reached += mass;
      ++cell;
      mass = 0.5 * width_ * (a[cell] + a[cell + 1]);
    }
    const double rest = std::max(0.0, u * total - reached);
    const double slope = (a[cell + 1] - a[cell]) / width_;
    const double density = std::sqrt(std::max(a[cell] * a[cell] + 2.0 * slope * rest, 1e-300));
    const double offset = std::min(2.0 * rest / (a[cell] + density), width_);
    const double sum_slope = (sum_[cell + 1] - sum_[cell]) / width_;
    const int stratum = backwards_[wavelength] ? strata_ - 1 - i : i;
    samples_[wavelength * strata_ + stratum] = {
        cell, offset, density, u, cell * width_ + offset, sum_[cell] + sum_slope * offset, sum_slope};
  }
}

void DensityModel::gradient(std::span<double> by_v) const {
  for (int k = 0; k < wavelengths(); ++k) {
    const double* a = &a_[k * nodes_];
    const Pull* pull = &pull_[k * nodes_];

    // S is Σ a/Z, and t moves by (u dZ − dA(t))/a(t).
    double by_total = by_total_[k];
    for (int b = 0; b < nodes_; ++b) by_total -= by_sum_[b] * a[b] / (total_[k] * total_[k]);

    double beyond = 0.0;  // of all samples in cells after the node
    for (int b = nodes_ - 1; b >= 0; --b) {
      const double half = b > 0 ? 0.5 * width_ : 0.0;  // the hat's part left of the node
      double by_a = by_sum_[b] / total_[k] + hat(b) * (by_total - beyond);
      by_a -= half * pull[b].whole + pull[b].left;
      if (b > 0) by_a -= pull[b - 1].right;
      by_v[k * nodes_ + b] = by_a * a[b];
      beyond += pull[b].whole;
    }
  }
}

}  // namespace photopic
