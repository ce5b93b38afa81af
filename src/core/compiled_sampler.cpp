#include "core/compiled_sampler.h"

#include <bit>
#include <cmath>
#include <numeric>

#include "spectral/knots.h"

namespace photopic {
namespace {

constexpr double kQuanta = 0x1p32;  ///< of u
constexpr int kMostStepBits = 14;   ///< a larger guide would be further away than a search takes

/// Every sampler in one form: densities q_k on t, all with the same knots, over a base.
struct Form {
  PiecewiseLinearDensity base;
  std::vector<PiecewiseLinearDensity> q;
  std::vector<bool> backwards{};
  bool turns = false;  ///< the q_k are driven by u + k/N, wrapped round
};

/// Of N densities that are constant on `steps` equal cells of t.
/// @param value_of gives density k's on a cell
template <typename ValueOf>
Form stepped(PiecewiseLinearDensity base, int count, int steps, const ValueOf& value_of) {
  WavelengthDistribution distribution{.base = std::move(base), .components = {}, .stepped = true};
  for (int k = 0; k < count; ++k) {
    auto& nodes = distribution.components.emplace_back().nodes;
    for (int i = 0; i < steps; ++i) nodes.push_back(value_of(k, i));
  }
  return {distribution.base, densities_on_t(distribution)};
}

Form equally_spaced(PiecewiseLinearDensity base, int count) {
  Form form = stepped(std::move(base), count, 1, [](int, int) { return 1.0; });
  form.turns = true;
  return form;
}

Form form_of(const UniformWavelengths& s) {
  return equally_spaced({{kLambdaMin, kLambdaMax}, {1.0, 1.0}}, s.count);
}

Form form_of(const VisibleWavelengths& s) {
  std::vector<double> nm, value;
  for (int i = 0; i < Observer::kTableSize; ++i) {
    nm.push_back(kLambdaMin + i);
    value.push_back(density_sum(s, nm.back()));
  }
  return equally_spaced({std::move(nm), std::move(value)}, s.count);
}

Form form_of(const IlluminantWavelengths& s) {
  return stepped(s.base, s.count, s.count, [](int k, int i) { return k == i ? 1.0 : 0.0; });
}

Form form_of(const OptimizedWavelengths& s) {
  return {s.base(), s.densities(), s.backwards()};
}

/// A linear function on a cell.
struct Line {
  double begin, slope;
};

/// Of a polygon, between two of whose knots the cell lies.
Line line_on(std::span<const double> x, std::span<const double> value, double from, double to) {
  const auto beyond = std::upper_bound(x.begin() + 1, x.end() - 1, std::midpoint(from, to));
  const auto i = static_cast<std::size_t>(beyond - x.begin()) - 1;
  const double width = x[i + 1] - x[i], slope = width > 0.0 ? (value[i + 1] - value[i]) / width : 0.0;
  return {std::max(0.0, value[i] + slope * (from - x[i])), slope};
}

/// x̄, ȳ, z̄ over ∫ȳ dλ.
std::vector<TabulatedSpectrum> columns_of(const Observer& observer) {
  std::vector<double> nm;
  std::array<std::vector<double>, 3> value;
  for (int i = 0; i < Observer::kTableSize; ++i) {
    nm.push_back(kLambdaMin + i);
    const Xyz h = observer(nm.back()) * (1.0 / observer.y_integral());
    value[0].push_back(h.x), value[1].push_back(h.y), value[2].push_back(h.z);
  }
  std::vector<TabulatedSpectrum> columns;
  for (auto& one : value) columns.emplace_back(nm, std::move(one), Beyond::zero);
  return columns;
}

}  // namespace

struct CompiledSampler::Build {
  CompiledSampler& compiled;
  Form form;
  std::vector<TabulatedSpectrum> spectra;         ///< of the observer, then the emissions
  std::vector<double> knots;                      ///< of the cells, and the end of the last [nm]
  std::vector<double> t;                          ///< B of each
  std::vector<std::vector<double>> least_bits{};  ///< of each density in each cell

  Build(CompiledSampler& into, const WavelengthSampler& sampler, const Observer& observer,
        std::span<const TabulatedSpectrum> emissions)
      : compiled(into),
        form(std::visit([](const auto& s) { return form_of(s); }, sampler)),
        spectra(columns_of(observer)) {
    spectra.insert(spectra.end(), emissions.begin(), emissions.end());
    knots.assign(form.base.x().begin(), form.base.x().end());
    for (const double at : form.q[0].x()) knots.push_back(form.base.inverse(at));
    for (const TabulatedSpectrum& one : spectra)
      knots.insert(knots.end(), one.lambda().begin(), one.lambda().end());
    knots = knots_in_range(std::move(knots));
    for (const double nm : knots) t.push_back(form.base.cdf(nm));
  }

  std::size_t cells() const { return knots.size() - 1; }

  /// Of four spectra from one on.
  Columns columns(std::size_t cell, std::size_t from) const {
    Columns c{};
    for (std::size_t i = 0; i < 4 && from + i < spectra.size(); ++i) {
      const double begin = spectra[from + i].limit_from_right(knots[cell]);
      c.at_begin[i] = static_cast<float>(begin);
      c.rise[i] = static_cast<float>(spectra[from + i].limit_from_left(knots[cell + 1]) - begin);
    }
    return c;
  }

  void add_cells() {
    std::vector<double> sum(form.q[0].value().size());
    for (const PiecewiseLinearDensity& q : form.q)
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += q.value()[i];
    for (std::size_t i = 0; i < cells(); ++i) {
      const double from = knots[i], width = knots[i + 1] - from;
      const Line b = line_on(form.base.x(), form.base.value(), from, knots[i + 1]),
                 s = line_on(form.q[0].x(), sum, t[i], t[i + 1]);
      compiled.cells_.push_back({.lambda = static_cast<float>(from),
                                 .width = static_cast<float>(width),
                                 .per_width = static_cast<float>(1.0 / width),
                                 .b = static_cast<float>(b.begin),
                                 .b_slope = static_cast<float>(b.slope),
                                 .sum = static_cast<float>(s.begin),
                                 .sum_slope = static_cast<float>(s.slope)});
    }
  }

  void add_columns() {
    for (std::size_t from = 0; from < spectra.size(); from += 4) {
      auto& list = compiled.columns_.emplace_back();
      for (std::size_t i = 0; i < cells(); ++i) list.push_back(columns(i, from));
    }
  }

  void add_density(const PiecewiseLinearDensity& q) {
    auto& least = least_bits.emplace_back();
    auto& crossings = compiled.crossings_.emplace_back();
    for (std::size_t i = 0; i < cells(); ++i) {
      const double begin = q.cdf(t[i]) * kQuanta, first = std::max(std::ceil(begin - 0.5), 0.0);
      const double inside = std::max(first + 0.5 - begin, 0x1p-8), before = std::max(first - 1.0, 0.0);
      const Line line = line_on(q.x(), q.value(), t[i], t[i + 1]);
      crossings.push_back({.before = static_cast<std::uint32_t>(before),
                           .rest = static_cast<float>(inside - (first - before)),
                           .q = static_cast<float>(line.begin),
                           .q_slope = static_cast<float>(line.slope)});
      least.push_back(first);
    }
    crossings.push_back({.before = ~0u, .rest = 0.0f, .q = 0.0f, .q_slope = 0.0f});
  }

  void add_drives() {
    const std::size_t count = form.q.size();
    for (std::size_t k = 0; k < count; ++k) {
      Drive& drive = compiled.drives_.emplace_back();
      if (!form.backwards.empty() && form.backwards[k]) drive.flip = ~0u;
      if (form.turns)
        drive.turn =
            static_cast<std::uint32_t>(kQuanta * static_cast<double>(k) / static_cast<double>(count));
    }
  }

  /// For each step where its least number leads.
  void add_guide() {
    const int bits = std::min(static_cast<int>(std::bit_width(2 * cells())), kMostStepBits);
    const std::uint32_t size = 1u << (32 - bits);
    for (std::uint32_t step = 0; step < 1u << bits; ++step) {
      for (std::size_t k = 0; k < form.q.size(); ++k) {
        const Drive& drive = compiled.drives_[k];
        const double least = drive(drive.flip ? step * size + (size - 1) : step * size);
        const auto next = std::ranges::upper_bound(least_bits[k], least);
        compiled.guide_.push_back(static_cast<std::uint32_t>(next - least_bits[k].begin()) - 1);
      }
    }
    compiled.step_bits_ = bits;
  }
};

CompiledSampler::CompiledSampler(const WavelengthSampler& sampler, const Observer& observer,
                                 std::span<const TabulatedSpectrum> emissions) {
  Build build(*this, sampler, observer, emissions);
  build.add_cells();
  build.add_columns();
  for (const PiecewiseLinearDensity& q : build.form.q) build.add_density(q);
  build.add_drives();
  build.add_guide();
}

}  // namespace photopic
