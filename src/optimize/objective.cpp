#include "optimize/objective.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "spectral/lamp_set.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

double dot(const Channels& a, const Channels& b) {
  using Quarter [[gnu::vector_size(kChannels / 4 * sizeof(double))]] = double;
  const Channels product = a * b;
  Quarter parts[4];
  std::memcpy(parts, &product, sizeof product);
  const Quarter sum = (parts[0] + parts[1]) + (parts[2] + parts[3]);
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// A place between two of a table's nodes.
struct Position {
  int cell;
  double f;
};

Position position_in(const TargetTable& table, double t) {
  const double x = t * table.cells();
  const int cell = std::min(static_cast<int>(x), table.cells() - 1);
  return {cell, x - cell};
}

/// Of a target that is black, up to rounding [ΔE²].
constexpr double kNoVariance = 1e-20;

}  // namespace

Xyz white_of(White white, const TabulatedSpectrum& light) {
  if (white == White::d65) return d65_white();
  const Xyz lamp = emission_xyz(make_emitter(light).emission, Observer::cie1931());
  return lamp * (1.0 / lamp.y);
}

EstimateLoss::EstimateLoss(const Targets& targets, const PiecewiseLinearDensity& base)
    : objective_(targets.objective) {
  white_ = white_of(targets.white, targets.mixed);
  if (objective_ == Objective::mean_delta_e) {
    table_ = xyz_table(base, make_emitter(targets.mixed));
    const Xyz color{table_.integral[0], table_.integral[1], table_.integral[2]};
    reference_ = xyz_to_lab(color, white_);
    return;
  }

  std::vector<Emitter> lamps;
  for (const TabulatedSpectrum& emission : targets.emitters) lamps.push_back(make_emitter(emission));
  TargetBasis basis = target_basis(base, lamps, targets.reflectances, white_);
  table_ = std::move(basis.table);
  for (const auto& rows : basis.coordinates) {
    Matrix form{};
    for (int a = 0; a < kChannels; ++a)
      for (const Channels& row : rows) form[a] += row[a] * row;
    forms_.push_back(form);
  }
  const auto count = static_cast<double>(targets.reflectances.size());
  for (const double share : luminance_shares(targets.emitters))
    weights_.insert(weights_.end(), targets.reflectances.size(), share / count);
}

double EstimateLoss::operator()(std::span<Channels> estimates) const {
  return objective_ == Objective::asymptotic ? asymptotic(estimates) : mean_delta_e(estimates);
}

double EstimateLoss::asymptotic(std::span<Channels> estimates) const {
  // The covariance of the channels serves all targets.
  const double share = 1.0 / static_cast<double>(estimates.size());
  Matrix covariance{};
  for (Channels& e : estimates) {
    e -= table_.integral;
    for (int a = 0; a < kChannels; ++a) covariance[a] += share * e[a] * e;
  }

  // Σ_m w_m sqrt(tr(A_m C)), and its derivative by C.
  double value = 0.0;
  Matrix by_covariance{};
  for (std::size_t m = 0; m < forms_.size(); ++m) {
    const Matrix& form = forms_[m];
    double variance = 0.0;
    for (int a = 0; a < kChannels; ++a) variance += dot(form[a], covariance[a]);
    if (variance <= kNoVariance) continue;  // black has none, and the root no derivative there
    const double deviation = std::sqrt(variance);
    value += weights_[m] * deviation;
    for (int a = 0; a < kChannels; ++a) by_covariance[a] += 0.5 * weights_[m] / deviation * form[a];
  }

  for (Channels& e : estimates) {
    Channels by_estimate{};
    for (int a = 0; a < kChannels; ++a) by_estimate += 2.0 * share * e[a] * by_covariance[a];
    e = by_estimate;
  }
  return value;
}

double EstimateLoss::mean_delta_e(std::span<Channels> estimates) const {
  const double share = 1.0 / static_cast<double>(estimates.size());
  double value = 0.0;
  for (Channels& e : estimates) {
    const SmoothDeltaE delta_e = smooth_delta_e(reference_, {e[0], e[1], e[2]}, white_);
    value += share * delta_e.value;
    e = Channels{share * delta_e.gradient.x, share * delta_e.gradient.y, share * delta_e.gradient.z};
  }
  return value;
}

ObjectiveFunction::ObjectiveFunction(std::shared_ptr<const EstimateLoss> loss, std::vector<bool> backwards,
                                     int nodes, int strata)
    : loss_(std::move(loss)), model_(std::move(backwards), nodes, strata), estimates_(strata) {}

double ObjectiveFunction::operator()(std::span<const double> v, std::span<double> gradient) {
  model_.draw(v);
  estimate();
  const double value = (*loss_)(estimates_);
  if (!gradient.empty()) {
    pull_back();
    model_.gradient(gradient);
  }
  return value;
}

void ObjectiveFunction::estimate() {
  const TargetTable& table = loss_->table();
  std::fill(estimates_.begin(), estimates_.end(), Channels{});
  for (int k = 0; k < model_.wavelengths(); ++k)
    for (int i = 0; i < model_.strata(); ++i) {
      const DensityModel::Sample& sample = model_.sample(k, i);
      const auto [cell, f] = position_in(table, sample.t);
      estimates_[i] += (1.0 - f) / sample.sum * table.node[cell];
      estimates_[i] += f / sample.sum * table.node[cell + 1];
    }
}

void ObjectiveFunction::pull_back() {
  const TargetTable& table = loss_->table();
  for (int k = 0; k < model_.wavelengths(); ++k)
    for (int i = 0; i < model_.strata(); ++i) {
      // E = r/S: along the sample's way dE = (r′/S − r S′/S²) dt − r/S² dS.
      const DensityModel::Sample& sample = model_.sample(k, i);
      const auto [cell, f] = position_in(table, sample.t);
      const double left = dot(estimates_[i], table.node[cell]),
                   right = dot(estimates_[i], table.node[cell + 1]);
      const double r = left + f * (right - left), r_slope = (right - left) * table.cells();
      const double by_sum = -r / (sample.sum * sample.sum);
      model_.add(k, sample, r_slope / sample.sum + by_sum * sample.slope, by_sum);
    }
}

}  // namespace photopic
