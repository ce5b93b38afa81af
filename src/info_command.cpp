#include <fmt/format.h>

#include <utility>

#include "commands.h"
#include "error.h"
#include "output_file.h"
#include "scene_report.h"
#include "scene_setup.h"
#include "text_table.h"

namespace photopic {
namespace {

constexpr std::size_t kMaxRows = 60;  // of a table on a terminal; the JSON has them all

ReportSection report_file(const InfoArguments& arguments, const GltfContents& contents) {
  ReportSection section{"file", arguments.scene.scene.string(), {}, {}};
  const auto add = [&](const char* name, std::size_t count) {
    section.json[name] = count;
    if (count > 0) section.rows.push_back({name, std::to_string(count)});
  };
  section.json["name"] = arguments.scene.scene.string();
  add("scenes", contents.scenes.size());
  add("nodes", contents.nodes);
  add("meshes", contents.meshes);
  add("primitives", contents.primitives);
  add("animations", contents.animations);
  section.json["extensions_used"] = contents.extensions_used;
  section.json["extensions_required"] = contents.extensions_required;
  const char* heading = "extensions";
  for (const std::string& name : contents.extensions_used)
    section.rows.push_back({std::exchange(heading, ""), name});
  return section;
}

ReportSection report_warnings(const Scene& scene) {
  ReportSection section{"warnings", "warnings", {}, scene.warnings};
  for (const std::string& warning : scene.warnings) section.rows.push_back({warning});
  return section;
}

/// On stderr, where no tables are asked for.
void print_warnings(const Scene& scene) {
  for (const std::string& warning : scene.warnings) print_warning(warning);
}

void print_section(ReportSection section) {
  print_out(fmt::format("{}{}\n", section.key == "file" ? "" : "\n", without_controls(section.title)));
  const std::size_t count = section.rows.size();
  if (count > kMaxRows) section.rows.resize(kMaxRows);
  for (auto& row : section.rows) row.front().insert(0, "  ");
  print_out(format_columns(section.rows));
  if (count > kMaxRows) print_out(fmt::format("  and {} more; --json has them all\n", count - kMaxRows));
}

}  // namespace

int run_info(const InfoArguments& arguments) {
  if (!arguments.json.empty()) check_writable_file(arguments.json);
  check_no_overwriting({arguments.json}, input_files(arguments.scene));
  const auto [scene, contents] = load_listed_gltf(arguments.scene.scene, gltf_options(arguments.scene));
  check_no_overwriting({arguments.json}, scene.files);

  const ReportSection sections[] = {report_file(arguments, contents), report_scenes(scene, contents),
                                    report_geometry(scene),           report_cameras(scene, contents),
                                    report_materials(scene),          report_textures(scene),
                                    report_lamps(scene, contents),    report_warnings(scene)};
  const bool report = prints_report(arguments.scene.quiet, arguments.json);
  nlohmann::ordered_json json = {{"version", PHOTOPIC_VERSION}};
  for (const ReportSection& section : sections) {
    json[section.key] = section.json;
    if (!section.json.empty() && !section.rows.empty() && report) print_section(section);
  }
  if (!report) print_warnings(scene);
  if (!arguments.json.empty()) write_json_file(arguments.json, json);
  return kExitDone;
}

}  // namespace photopic
