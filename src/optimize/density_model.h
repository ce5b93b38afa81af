#pragma once

#include <span>
#include <vector>

namespace photopic {

/// The unknowns of the search turned into wavelength samples: N densities q_k on t in [0, 1], piecewise
/// linear on equal cells with node values a = exp(v), and for each the samples t(u) at the midpoints of equal
/// strata of u. Exact derivatives flow back by the implicit function theorem: A(t) = u·Z, A the unnormalised
/// CDF, Z = A(1).
class DensityModel {
 public:
  /// One sample: where it fell, and what a derivative needs to know of the place.
  struct Sample {
    int cell;
    double offset;   ///< t − the cell's start
    double density;  ///< a(t), unnormalised
    double u;        ///< as the density sees it: 1 − u where it runs backwards
    double t;
    double sum;    ///< S(t) = Σ_k q_k(t)
    double slope;  ///< dS/dt
  };

  /// @param backwards N orientations  @param nodes ≥ 2  @param strata of u, ≥ 1
  DensityModel(std::vector<bool> backwards, int nodes, int strata);

  int wavelengths() const { return static_cast<int>(backwards_.size()); }
  int nodes() const { return nodes_; }
  int strata() const { return strata_; }
  int unknowns() const { return wavelengths() * nodes_; }

  /// Draws all samples for v, node by node, density by density; also clears the derivatives.
  void draw(std::span<const double> v);
  const Sample& sample(int wavelength, int stratum) const { return samples_[wavelength * strata_ + stratum]; }

  /// Adds the derivatives of a function by one sample's position (the change of S(t) with it included) and by
  /// S.
  void add(int wavelength, const Sample& sample, double by_t, double by_sum) {
    const double d = by_t / sample.density, s = sample.offset, half = 0.5 * s * s / width_;
    Pull& pull = pull_[wavelength * nodes_ + sample.cell];
    pull.whole += d, pull.left += d * (s - half), pull.right += d * half;
    by_total_[wavelength] += d * sample.u;
    const double f = s / width_;
    by_sum_[sample.cell] += by_sum * (1.0 - f), by_sum_[sample.cell + 1] += by_sum * f;
  }

  /// The gradient by v of all that was added.
  void gradient(std::span<double> by_v) const;

 private:
  /// What the samples in one cell ask of A: at the whole of the nodes before it, and of the hats of its two
  /// nodes.
  struct Pull {
    double whole = 0, left = 0, right = 0;
  };
  void draw_density(int wavelength);
  double hat(int node) const { return node == 0 || node == nodes_ - 1 ? 0.5 * width_ : width_; }

  std::vector<bool> backwards_;
  int nodes_, strata_;
  double width_;                         ///< of a cell
  std::vector<double> a_, total_, sum_;  ///< exp(v); Z of each density; S at the nodes
  std::vector<Sample> samples_;
  std::vector<Pull> pull_;
  std::vector<double> by_total_, by_sum_;
};

}  // namespace photopic
