#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace photopic {

/// One struct of arguments and one function for each subcommand; command_line.cpp binds the options to the
/// fields. Every run_* returns the exit code.
/// @throws InputError when something the user gave is wrong

inline constexpr int kExitDone = 0;
inline constexpr int kExitBadInput = 1;
inline constexpr int kExitInternalError = 2;
inline constexpr int kExitInterrupted = 130;  ///< 128 + SIGINT, as shells have it

/// How render and compare load a scene and draw its samples.
struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> emitters;  ///< "[NAME=]SPECTRUM"
  std::string camera;                 ///< empty: the scene's first
  std::filesystem::path environment;  ///< a picture of the surroundings; empty: none
  double environment_rotation = 0.0;  ///< about +y [degrees]
  double environment_strength = 1.0;
  double punctual_scale = 1.0;  ///< factor on the intensities of punctual lights
  std::string resolution;       ///< "WxH" [pixels]; empty: the camera's

  int spp = 64;                        ///< samples per pixel
  int wavelengths = 0;                 ///< a path's: 1, 4, 8 or 16; 0: the distribution's, else 4
  std::filesystem::path distribution;  ///< of the optimised sampler; empty: optimise on the spot
  bool no_cache = false;
  std::string sequence = "sobol";  ///< or "independent"
  int max_depth = 64;              ///< surfaces met by a path at most
  int batch_size = 1024;           ///< paths advanced together
  double exposure = 0.0;           ///< [EV], of 8-bit outputs only
  std::uint32_t seed = 0;
  bool stats = false;
  bool quiet = false;
};

struct RenderArguments {
  SceneArguments scene;
  std::vector<std::filesystem::path> outputs;
  std::string sampler = "optimized";
  std::filesystem::path json;
};
int run_render(const RenderArguments& arguments);

struct CompareArguments {
  SceneArguments scene;
  std::vector<std::string> samplers{"uniform", "visible", "illuminant", "optimized"};
  std::filesystem::path reference;  ///< an image; empty: rendered
  int reference_spp = 0;            ///< 0: 16 times the runs', at least 1,024
  std::vector<int> curve;           ///< further samples per pixel at which the mean ΔE is measured
  int repeat = 1;                   ///< timed rounds over all samplers
  std::string white = "D65";        ///< or "illuminant"
  std::filesystem::path json;
  std::filesystem::path report;  ///< a folder for images, color bars and the table
};
int run_compare(const CompareArguments& arguments);

struct OptimizeArguments {
  std::vector<std::string> spectra;  ///< "SPECTRUM[*POWER]"
  std::filesystem::path output;
  int wavelengths = 4;                   ///< 1 … 16
  std::string objective = "asymptotic";  ///< or "mean-delta-e"
  std::string effort = "default";        ///< or "quick", "thorough"
  std::string white = "D65";             ///< or "illuminant"
  std::uint32_t seed = 1;
  std::filesystem::path color_bar;
  std::filesystem::path plot;
  std::filesystem::path json;
  bool quiet = false;
};
int run_optimize(const OptimizeArguments& arguments);

struct SpectrumArguments {
  std::string spectrum;
  std::filesystem::path plot;
  std::filesystem::path json;
  bool quiet = false;
};
int run_spectrum(const SpectrumArguments& arguments);

struct DiffArguments {
  std::filesystem::path reference;
  std::vector<std::filesystem::path> images;
  std::filesystem::path json;
};
int run_diff(const DiffArguments& arguments);

}  // namespace photopic
