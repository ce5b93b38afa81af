#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "integrator/integrator.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic::test {

/// The image's mean Y in closed form.
struct Luminance {
  double value;             ///< [cd/m²]
  double tolerance = 1e-4;  ///< relative: what rounding and tessellation may do to it
};

/// No light gets in: one sample that sees any is a leak.
struct Dark {};

/// A converged image, rendered when first asked for: cases may share it.
class Reference {
 public:
  Reference(std::string name, std::function<Film()> render)
      : name_(std::move(name)), render_(std::move(render)) {}
  const std::string& name() const { return name_; }
  const Film& film() {
    if (!film_) film_ = render_();
    return *film_;
  }

 private:
  std::string name_;
  std::function<Film()> render_;
  std::optional<Film> film_;
};
using SameAs = std::shared_ptr<Reference>;  ///< the same image, whole and by quarters

/// One row of the stress table.
struct StressCase {
  std::string topic, name;
  std::function<Scene()> scene;
  std::variant<Luminance, Dark, SameAs> expectation;
  int spp = 100, max_depth = 12;
  double largest_error = 0.02;  ///< of the mean Y, relative, so that the case can fail
  double brightest_pixel = 0;   ///< Y [cd/m²], no more: fireflies; 0: whatever
  /// Made for the scene's emission; none: by the illuminant.
  std::function<WavelengthSampler(const TabulatedSpectrum&)> sampler{};
};

/// The short form takes chosen steps and few samples, the full one whole ranges and many.
enum class Form { brief, full };

/// The one list of cases, gathered by topic.
class StressList {
 public:
  explicit StressList(Form form) : form_(form) {}

  Form form() const { return form_; }
  const std::vector<StressCase>& cases() const { return cases_; }
  void add(StressCase c) { cases_.push_back(std::move(c)); }

  std::vector<double> steps(std::vector<double> brief, std::vector<double> full) const {
    return form_ == Form::brief ? brief : full;
  }
  /// Powers of ten; in brief the ends and one between.
  std::vector<double> decades(int low, int high) const;

 private:
  Form form_;
  std::vector<StressCase> cases_;
};

StressList stress_list(Form form);

void add_scale_cases(StressList& list);
void add_view_cases(StressList& list);
void add_geometry_cases(StressList& list);
void add_coincidence_cases(StressList& list);
void add_leak_cases(StressList& list);
void add_shadow_cases(StressList& list);
void add_instance_cases(StressList& list);
void add_roughness_cases(StressList& list);
void add_material_cases(StressList& list);
void add_light_cases(StressList& list);
void add_glass_lamp_cases(StressList& list);

/// What became of a case.
struct Outcome {
  std::string expected;  ///< as text
  Estimate measured;     ///< the image's mean Y [cd/m²]
  double z = 0;          ///< the largest, where several means are compared
  std::size_t tests = 1;
  std::optional<std::size_t> leaks{};  ///< pixels that see light, where none may
  RenderStats stats;
  std::string problem{};  ///< empty: passed
};

/// @param tests in the whole list, that share a significance of 1 %
Outcome measure(const StressCase& c, Form form, std::size_t tests);

/// How many numbers the list compares.
std::size_t count_tests(const StressList& list);

/// Renders with independent numbers; no statistics of it are stratified.
RenderResult render_case(const StressCase& c, int spp, std::uint32_t seed);
/// The same by another scene than a case's, or by the oracle.
Film render_reference(const Scene& scene, int spp, int max_depth);
Film render_oracle(const Scene& scene, int spp, int max_depth);

/// A builder as a case's scene.
std::function<Scene()> built(SceneBuilder builder);

/// The reflectance of a plane interface for unpolarised light (Born & Wolf 1999, section 1.5.2), in double.
/// @param cos_i on the side of index 1, in (0, 1] @param n of the other side
double fresnel(double cos_i, double n);

/// "name 0.001"
std::string with_number(const std::string& name, double x);

}  // namespace photopic::test
