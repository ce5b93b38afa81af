// How much of a render is ray traversal: records the rays of a render (nearest-hit and shadow, in the order
// and the packets in which Embree gets them), traces them again alone, and compares the times.
//   replay SCENE [--emitter SPECTRUM] [--resolution WxH] [--spp N] [--wavelengths N] [--sampler NAME] …
// Times are CPU seconds, medians of alternating rounds. `pure`: Embree's calls alone, on packets that are
// ready; `Accel`: our class's, which packs rays and unpacks hits as well; `shuffled`: Embree's on the same
// rays in any order, which is what it takes for rays that have nothing in common.
#include <tbb/combinable.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <stdexcept>

#include "bench_scene.h"
#include "ray_tape.h"

using namespace photopic;

namespace {

constexpr std::size_t kTaskPackets = 4096;

struct Setting {
  const BenchRequest& request;
  const PreparedScene& scene;
  const WavelengthSampler& sampler;
};

RayTape record(const Setting& setting) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  RayTape tape;
  RenderStats stats;
  {
    const Recording recording(tape);
    stats = render(setting.scene, setting.sampler, setting.request.render).stats;
  }
  if (tape.rays != stats.rays || tape.shadow_rays != stats.shadow_rays)
    throw std::runtime_error("the renderer traced rays otherwise than by rtcIntersect16 and rtcOccluded16");
  std::printf(
      "%zu paths of %d wavelengths, at most %d surfaces: %.3f rays and %.3f shadow rays a path, "
      "%.1f of 16 lanes filled\n",
      static_cast<std::size_t>(stats.paths), setting.request.wavelengths, setting.request.render.max_depth,
      double(tape.rays) / double(stats.paths), double(tape.shadow_rays) / double(stats.paths),
      double(tape.rays + tape.shadow_rays) / double(tape.packets.size()));
  return tape;
}

/// The packets in parts, as threads take them. @return the sum of the parts' seconds
double in_parts(std::span<const RayPacket> packets,
                const std::function<double(std::span<const RayPacket>)>& seconds_of) {
  tbb::combinable<double> sums(0.0);
  const std::size_t parts = (packets.size() + kTaskPackets - 1) / kTaskPackets;
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t i) {
    const std::size_t first = i * kTaskPackets;
    sums.local() += seconds_of(packets.subspan(first, std::min(kTaskPackets, packets.size() - first)));
  });
  return sums.combine(std::plus<>());
}

double pure_seconds(const RayTape& tape, std::span<const RayPacket> packets) {
  return in_parts(packets, [&](auto part) { return traverse(tape.scene, part).seconds; });
}

/// Embree must answer as it did.
void check_answers(const RayTape& tape) {
  const Traversal again = traverse(tape.scene, tape.packets);
  if (again.hits != tape.hits || again.blocked != tape.blocked)
    throw std::runtime_error("the rays hit other things when they are traced again");
}

/// The same packets through Accel, each batch ending where a packet was not full.
class AccelReplay {
 public:
  explicit AccelReplay(const Accel& accel)
      : accel_(accel), rays_(kCapacity), hits_(kCapacity), shadows_(kCapacity) {}

  double seconds(std::span<const RayPacket> packets) {
    seconds_ = 0.0;
    for (const RayPacket& packet : packets) {
      const bool coherent = packet.flags != 0;
      if (!slots_.empty() && (packet.shadow != shadow_ || coherent != coherent_)) flush();
      shadow_ = packet.shadow, coherent_ = coherent;
      add(packet);
      if (slots_.size() + kPacketSize > kCapacity || slots_.size() % kPacketSize != 0) flush();
    }
    flush();
    return seconds_;
  }

 private:
  static constexpr std::size_t kCapacity = 1024;

  void add(const RayPacket& p) {
    for (std::size_t i = 0; i < kPacketSize; ++i) {
      if ((p.valid >> i & 1u) == 0) continue;
      const auto slot = static_cast<std::uint32_t>(slots_.size());
      rays_.set(slot, {{p.org_x[i], p.org_y[i], p.org_z[i]}, {p.dir_x[i], p.dir_y[i], p.dir_z[i]}},
                p.tfar[i]);
      slots_.push_back(slot);
    }
  }

  void flush() {
    const double start = thread_cpu_seconds();
    if (shadow_)
      accel_.occluded(rays_, slots_, shadows_);
    else
      accel_.intersect(rays_, slots_, hits_, coherent_);
    seconds_ += thread_cpu_seconds() - start;
    slots_.clear();
  }

  const Accel& accel_;
  RayArray rays_;
  std::vector<Hit> hits_;
  std::vector<Shadow> shadows_;
  std::vector<std::uint32_t> slots_;
  bool shadow_ = false, coherent_ = false;
  double seconds_ = 0.0;
};

double accel_seconds(const Setting& setting, std::span<const RayPacket> packets) {
  return in_parts(packets, [&](auto part) { return AccelReplay(setting.scene.accel).seconds(part); });
}

double render_seconds(const Setting& setting) {
  const double start = process_cpu_seconds();
  render(setting.scene, setting.sampler, setting.request.render);
  return process_cpu_seconds() - start;
}

/// A row of the table.
struct Times {
  std::vector<double> render, pure, accel, shuffled, nearest, shadow, ratio, shuffled_ratio;
};

void measure(const Setting& setting, const RayTape& tape, std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const auto first_shadow = static_cast<std::ptrdiff_t>(
      std::count_if(tape.packets.begin(), tape.packets.end(), [](const RayPacket& p) { return !p.shadow; }));
  std::vector<RayPacket> by_kind = tape.packets;
  std::stable_partition(by_kind.begin(), by_kind.end(), [](const RayPacket& p) { return !p.shadow; });
  const std::span nearest(by_kind.begin(), by_kind.begin() + first_shadow);
  const std::span shadow(by_kind.begin() + first_shadow, by_kind.end());

  const std::vector<RayPacket> out_of_order = shuffled(tape.packets);

  Times t;
  for (int round = 0; round < setting.request.rounds; ++round) {
    t.render.push_back(render_seconds(setting));
    t.pure.push_back(pure_seconds(tape, tape.packets));
    t.accel.push_back(accel_seconds(setting, tape.packets));
    t.shuffled.push_back(pure_seconds(tape, out_of_order));
    t.nearest.push_back(pure_seconds(tape, nearest));
    t.shadow.push_back(pure_seconds(tape, shadow));
    t.ratio.push_back(t.render.back() / t.pure.back());
    t.shuffled_ratio.push_back(t.render.back() / t.shuffled.back());
  }
  const double pure = median_of(t.pure);
  std::printf("%7zu %9.3f %9.3f %9.3f %11.3f %12.2f %12.2f %14.3f %13.3f %18.3f\n", threads,
              median_of(t.render), pure, median_of(t.accel), median_of(t.shuffled),
              double(tape.rays) * 1e-6 / median_of(t.nearest),
              double(tape.shadow_rays) * 1e-6 / median_of(t.shadow), median_of(t.ratio),
              median_of(t.accel) / pure, median_of(t.shuffled_ratio));
}

void run(const BenchRequest& request) {
  const auto scene = load_bench_scene(request);
  const WavelengthSampler sampler = bench_sampler(request, *scene);
  const Setting setting{request, *scene, sampler};
  const RayTape tape = record(setting);
  check_answers(tape);
  std::printf("%7s %9s %9s %9s %11s %12s %12s %14s %13s %18s\n", "threads", "render s", "pure s", "Accel s",
              "shuffled s", "M nearest/s", "M shadow/s", "render / pure", "Accel / pure",
              "render / shuffled");
  const auto all = static_cast<std::size_t>(tbb::info::default_concurrency());
  measure(setting, tape, 1);
  if (all > 1) measure(setting, tape, all);
}

}  // namespace

int main(int count, char** words) {
  return run_bench("replay", run, count, words);
}
