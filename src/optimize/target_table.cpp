#include "optimize/target_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "spectral/observer.h"

namespace photopic {
namespace {

constexpr int kCells = 1024;       ///< of the table in t
constexpr int kPointsPerCell = 8;  ///< for the averages over them

/// One function on the table's nodes.
using Row = std::vector<double>;

/// The wavelengths at midpoints of t with their base densities.
std::vector<PiecewiseLinearDensity::Draw> fine_points(const PiecewiseLinearDensity& base) {
  constexpr int kPoints = kCells * kPointsPerCell;
  std::vector<PiecewiseLinearDensity::Draw> points;
  points.reserve(kPoints);
  for (int p = 0; p < kPoints; ++p) points.push_back(base.draw((p + 0.5) / kPoints));
  return points;
}

/// The mean of a finely sampled function over each node's hat function; the trapezoid rule then has its exact
/// mean.
Row hat_averages(std::span<const double> fine) {
  Row row(kCells + 1, 0.0), weight(kCells + 1, 0.0);
  for (int p = 0; p < static_cast<int>(fine.size()); ++p) {
    const int i = p / kPointsPerCell;
    const double f = (p % kPointsPerCell + 0.5) / kPointsPerCell;
    row[i] += (1.0 - f) * fine[p], weight[i] += 1.0 - f;
    row[i + 1] += f * fine[p], weight[i + 1] += f;
  }
  for (int i = 0; i <= kCells; ++i) row[i] /= weight[i];
  return row;
}

double inner_product(const Row& a, const Row& b) {
  double sum = 0.5 * (a.front() * b.front() + a.back() * b.back());
  for (int i = 1; i < kCells; ++i) sum += a[i] * b[i];
  return sum / kCells;
}

double integral(const Row& row) {
  double sum = 0.5 * (row.front() + row.back());
  for (int i = 1; i < kCells; ++i) sum += row[i];
  return sum / kCells;
}

/// scale·h·I/b at the fine points.
std::vector<Xyz> weighted_observer(std::span<const PiecewiseLinearDensity::Draw> points,
                                   const Emitter& emitter) {
  const Observer& observer = Observer::cie1931();
  std::vector<Xyz> values;
  values.reserve(points.size());
  for (const auto& [lambda, b] : points) {
    const double weight = b > 0.0 ? emitter.scale * emitter.emission(lambda) / b : 0.0;
    values.push_back(observer(lambda) * weight);
  }
  return values;
}

/// The three rows X, Y, Z of one target.
std::array<Row, 3> xyz_rows(std::span<const PiecewiseLinearDensity::Draw> points,
                            std::span<const Xyz> weighted, const Spectrum& reflectance) {
  std::array<std::vector<double>, 3> fine;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Xyz xyz = weighted[p] * evaluate(reflectance, points[p].x);
    fine[0].push_back(xyz.x), fine[1].push_back(xyz.y), fine[2].push_back(xyz.z);
  }
  return {hat_averages(fine[0]), hat_averages(fine[1]), hat_averages(fine[2])};
}

TargetTable make_table(std::span<const Row> rows) {
  TargetTable table{std::vector<Channels>(kCells + 1, Channels{})};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (int i = 0; i <= kCells; ++i) table.node[i][k] = rows[k][i];
    table.integral[k] = integral(rows[k]);
  }
  return table;
}

/// The rows of U·(X, Y, Z): in ΔE.
void to_metric(std::array<Row, 3>& rows, const ColorMetric& metric) {
  for (int i = 0; i <= kCells; ++i) {
    const Xyz scaled = measured(metric, {rows[0][i], rows[1][i], rows[2][i]});
    rows[0][i] = scaled.x, rows[1][i] = scaled.y, rows[2][i] = scaled.z;
  }
}

/// Pivoted Gram–Schmidt: takes the largest row as the next basis function, removes it from all, and so on.
/// @return coordinates[row][function]
std::vector<Channels> orthonormalise(std::vector<Row>& rows, std::vector<Row>& basis) {
  constexpr double kEnough = 1e-5;  // [ΔE]: far below what an estimate will ever reach
  std::vector<Channels> coordinates(rows.size(), Channels{});
  for (int k = 0; k < kChannels; ++k) {
    std::vector<double> energy;
    for (const Row& row : rows) energy.push_back(inner_product(row, row));
    const auto pivot = std::max_element(energy.begin(), energy.end()) - energy.begin();
    if (energy[pivot] < kEnough * kEnough) break;
    Row function = rows[pivot];
    for (double& f : function) f /= std::sqrt(energy[pivot]);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      coordinates[r][k] = inner_product(rows[r], function);
      for (int i = 0; i <= kCells; ++i) rows[r][i] -= coordinates[r][k] * function[i];
    }
    basis.push_back(std::move(function));
  }
  return coordinates;
}

}  // namespace

Emitter make_emitter(const TabulatedSpectrum& emission) {
  const auto values = emission.value();
  const double brightest = *std::max_element(values.begin(), values.end());
  if (!(brightest > 0.0)) throw std::invalid_argument("the emission is zero everywhere");
  TabulatedSpectrum unit = emission.scaled(1.0 / brightest);
  const double y = emission_xyz(unit, Observer::cie1931()).y * Observer::cie1931().y_integral();
  if (!(y > 0.0)) throw std::invalid_argument("the emission has no luminance from 360 to 830 nm");
  return {std::move(unit), 1.0 / y};
}

TargetTable xyz_table(const PiecewiseLinearDensity& base, const Emitter& emitter) {
  const auto points = fine_points(base);
  return make_table(xyz_rows(points, weighted_observer(points, emitter), ConstantSpectrum{1.0}));
}

TargetBasis target_basis(const PiecewiseLinearDensity& base, std::span<const Emitter> emitters,
                         std::span<const Spectrum> reflectances, Xyz white) {
  const auto points = fine_points(base);
  std::vector<Row> rows;
  for (const Emitter& emitter : emitters) {
    const auto weighted = weighted_observer(points, emitter);
    for (const Spectrum& reflectance : reflectances) {
      auto target = xyz_rows(points, weighted, reflectance);
      const Xyz color{integral(target[0]), integral(target[1]), integral(target[2])};
      to_metric(target, color_metric(color, white));
      for (Row& row : target) rows.push_back(std::move(row));
    }
  }

  std::vector<Row> functions;
  const std::vector<Channels> coordinates = orthonormalise(rows, functions);
  TargetBasis basis{make_table(functions), {}};
  for (std::size_t r = 0; r < rows.size(); r += 3)
    basis.coordinates.push_back({coordinates[r], coordinates[r + 1], coordinates[r + 2]});
  return basis;
}

}  // namespace photopic
