#include <memory>

#include "command_line_options.h"
#include "command_line_scene.h"
#include "commands.h"

namespace photopic {

void bind_compare(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<CompareArguments>();
  CLI::App& command = *add_command(
      app, "compare", "Render a scene with several wavelength samplers and tabulate their errors", action,
      run_compare, a);
  bind_scene(command, a->scene, "the optimised sampler and the reference");
  command.add_option("--samplers", a->samplers, "Samplers to compare; ratios are to the first")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str()
      ->check(one_of(kSamplers))
      ->type_name("NAME,…");
  auto* reference = command.add_option("--reference", a->reference,
                                       "Linear image to measure against, whole or of --crop's window alone; "
                                       "rendered if not given");
  reference->check(not_empty())->type_name("FILE.exr");
  command
      .add_option(
          "--reference-spp", a->reference_spp,
          "Samples per pixel of the rendered reference: optimised wavelengths, seeds of its own; if "
          "not given 16 times --spp and at least 1024, but with --time for no longer than 16 times that")
      ->check(CLI::Range(2, kMaxSamples))
      ->excludes(reference)
      ->type_name("N");
  command
      .add_option("--curve", a->curve,
                  "Also measure the mean ΔE and the seconds at these samples per pixel, whatever --time")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(samples_range())
      ->type_name("N,…");
  command
      .add_option("--repeat", a->repeat,
                  "Rounds over all samplers; times and their ratios are medians over the rounds")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  bind_white(command, a->white,
             "White of ΔE: D65, or the illuminant for an observer adapted to the scene's lamps");
  command
      .add_option("--report", a->report,
                  "Folder for each sampler's EXR and PNG, the reference's, the color bars and the table")
      ->check(not_empty())
      ->type_name("DIR");
  bind_seed(command, a->scene.seed);
  bind_threads(command, threads);
  bind_json(command, a->json);
  bind_quiet(command, a->scene.quiet, "No progress, no table; warnings and errors only");
  command.footer(
      std::string("\nΔE is CIEDE2000 on unclipped linear images. The n-th sampler renders with seed --seed + "
                  "n, so that\n"
                  "their means are independent and can be tested against each other (largest |z|).\n") +
      kSpectrumHelp +
      "\n\nExample: photopic compare box.gltf --emitter cie:FL11 --samplers uniform,optimized --report out");
}

}  // namespace photopic
