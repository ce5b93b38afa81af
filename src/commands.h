#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace photopic {

/// One struct of arguments and one function for each subcommand; command_line.cpp binds the options to the
/// fields. Every run_* returns the exit code.
/// @throws InputError when something the user gave is wrong, SearchStopped when Ctrl-C ended an optimisation

inline constexpr int kExitDone = 0;
inline constexpr int kExitBadInput = 1;
inline constexpr int kExitInternalError = 2;
inline constexpr int kExitSignal = 128;  ///< + the signal: see interrupt.h

/// What --sampler and --samplers may name; choose_sampler makes them.
inline const std::vector<std::string> kSamplers{"uniform", "visible", "illuminant", "optimized"};

/// How render and compare load a scene and draw its samples.
struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> emitters;  ///< "[NAME=]SPECTRUM"
  std::string scene_name;             ///< or index, of the file's; empty: the default
  std::string camera;                 ///< empty: the scene's first
  std::filesystem::path environment;  ///< a picture of the surroundings; empty: none
  double environment_rotation = 0.0;  ///< about +y [degrees]
  double environment_strength = 1.0;
  double punctual_scale = 1.0;  ///< factor on the intensities of punctual lights
  bool solid_glass = false;     ///< closed meshes that transmit are solid
  std::string resolution;       ///< "WxH" [pixels]; empty: the camera's
  std::string crop;             ///< "X0,Y0,X1,Y1" [pixels]: what alone is rendered; empty: all

  int spp = 64;                        ///< samples per pixel, at most
  double seconds = 0;                  ///< end a render after so long; 0: no limit
  double target_error = 0;             ///< expected mean ΔE at which a part of the image is done; 0: none
  int wavelengths = 0;                 ///< a path's: 1, 4, 8 or 16; 0: the distribution's, else 4
  std::filesystem::path distribution;  ///< of the optimised sampler; empty: optimise on the spot
  bool no_cache = false;
  std::string sequence = "sobol";  ///< or "independent"
  int observer = 1931;             ///< or 1964, the CIE standard observer
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
  std::string color = "srgb";     ///< what an EXR holds; or "xyz"
  std::string white_balance;      ///< the SPECTRUM that comes out white, or "illuminant"; empty: D65
  std::vector<std::string> aovs;  ///< layers of an EXR: names of kAovs
  int spectral_bins = 0;          ///< that an EXR holds besides; 0: none
  std::filesystem::path json;
};
int run_render(const RenderArguments& arguments);

struct CompareArguments {
  SceneArguments scene;
  std::vector<std::string> samplers = kSamplers;
  std::filesystem::path reference;  ///< an image; empty: rendered
  int reference_spp = 0;            ///< 0: 16 times the runs', at least 1,024, or 16 times their seconds
  std::vector<int> curve;           ///< further samples per pixel at which the mean ΔE is measured
  int repeat = 1;                   ///< timed rounds over all samplers
  std::string white = "D65";        ///< or "illuminant"
  std::filesystem::path json;
  std::filesystem::path report;  ///< a folder for images, color bars and the table
};
int run_compare(const CompareArguments& arguments);

struct InfoArguments {
  SceneArguments scene;  ///< the file, its scene, camera, resolution and emitters alone, and quiet
  std::filesystem::path json;
};
int run_info(const InfoArguments& arguments);

struct OptimizeArguments {
  std::vector<std::string> spectra;      ///< "SPECTRUM[*POWER]"
  std::filesystem::path output;          ///< empty where wavelengths are compared
  int wavelengths = 4;                   ///< 1 … 16
  bool compare_wavelengths = false;      ///< a table of N = 1, 2, 4, 8, 16 instead of a file
  std::string objective = "asymptotic";  ///< or "mean-delta-e"
  std::string effort = "default";        ///< or "quick", "thorough"
  int nodes = 0;                         ///< of each density; 0: the optimiser's own number
  std::string white = "D65";             ///< or "illuminant"
  std::filesystem::path reflectances;    ///< measured, further targets
  std::uint32_t seed = 1;
  std::filesystem::path color_bar;  ///< an image, or .svg with labels
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
  std::string white = "D65";  ///< of ΔE; or a SPECTRUM
  double exposure = 0.0;      ///< of both before ΔE [EV]
  std::filesystem::path map;  ///< a picture of the one image's ΔE, .exr or .png; empty: none
  std::filesystem::path json;
  bool quiet = false;
};
int run_diff(const DiffArguments& arguments);

}  // namespace photopic
