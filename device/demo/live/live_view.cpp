// Three threads: the servo loop, the server that watches it, and this one, which builds what the pages choose.
#include "live/live_view.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "bad_input.hpp"
#include "feeler/viewer/page.hpp"
#include "feeler/viewer/page_message.hpp"
#include "feeler/viewer/server.hpp"
#include "feeler/viewer/wire.hpp"
#include "live/interrupt.hpp"
#include "live/real_hand.hpp"
#include "live/serving.hpp"
#include "live/stage_description.hpp"
#include "live/stage_switch.hpp"
#include "live/tool_choice.hpp"
#include "real_device.hpp"

namespace feeler::demo {
namespace {

using Text = std::shared_ptr<const std::string>;

Text shared_text(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

/// What pages ask to be built, from the server's thread to this one. The latest wish counts.
class Wishes {
 public:
  void add(viewer::SceneRequest request) {
    const std::lock_guard lock(mutex_);
    wish_ = std::move(request);
    has_come_.notify_one();
  }
  std::optional<viewer::SceneRequest> wait_for(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    has_come_.wait_for(lock, time, [this] { return wish_.has_value(); });
    return std::exchange(wish_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::condition_variable has_come_;
  std::optional<viewer::SceneRequest> wish_;
};

/// A stage as pages are told of it.
struct Shown {
  std::shared_ptr<Stage> stage;
  Text text;
  Text mesh;
};

/// Makes stages from wishes.
class StageBuilder {
 public:
  /// @param device  a real one that is to feel the stages; none where the hand is simulated
  StageBuilder(const std::vector<GalleryEntry>& gallery, const Options& options, const Device* device)
      : gallery_(gallery), period_(1 / options.rate), workspace_(real_workspace(options.workspace_scale)), device_(device) {}

  /// @throws BadInput or std::invalid_argument with a sentence for the page
  Shown build(const viewer::SceneRequest& wish) {
    const GalleryEntry* entry = find_entry(gallery_, wish.scene);
    if (entry == nullptr) throw BadInput("There is no scene " + wish.scene + ".");
    LiveScene scene = make_scene(*entry, wish.variant, wish.clearance);
    choose_tool(scene, wish.tool);
    Settings<double> settings = scene.setting.settings();
    if (wish.stiffness) {
      const double length = scene.setting.length;
      settings.stiffness = Stiffness<double>::uniform(*wish.stiffness, *wish.stiffness * length * length);
    }
    if (wish.margin) settings.margin = *wish.margin;
    if (device_ != nullptr) {
      const double share = renderable_share(settings.stiffness, device_->specification(), WorkspaceMap(workspace_));
      settings.stiffness.translational *= share;
      settings.stiffness.rotational *= share;
    }
    const RenderChoice choice{wish.method.empty() ? "closest" : wish.method, wish.scalar.empty() ? "double" : wish.scalar};
    Shown shown;
    shown.stage = make_stage({++number_, std::move(scene), settings, choice, period_, device_ != nullptr});
    const std::string variant = wish.clearance ? "" : wish.variant.empty() ? entry->variants.front().label : wish.variant;
    shown.text = shared_text(stage_text(number_, shown.stage->scene(), {settings, choice},
                                        {entry->id, entry->title, entry->hint, variant, wish.clearance, wish.tool.empty() ? "own" : wish.tool}));
    const scenes::Setting& setting = shown.stage->scene().setting;
    shown.mesh = shared_text(viewer::encoded_mesh(number_, setting.vertices, setting.triangles));
    return shown;
  }

 private:
  const std::vector<GalleryEntry>& gallery_;
  double period_;
  WorkspaceSettings workspace_;
  const Device* device_;
  int number_ = 0;
};

/// The server's side: watches the loop through the feed and answers pages. All functions run on the server's thread.
class Watcher {
 public:
  /// @param device  the name of a real one, which no page moves; empty where the hand is simulated
  Watcher(viewer::LiveFeed& feed, Wishes& wishes, const std::string& device, Text hello, Shown first)
      : feed_(feed),
        wishes_(wishes),
        hello_(std::move(hello)),
        shown_(std::move(first)),
        page_(shared_text(std::string(viewer::page_html()))),
        refusal_of_hands_(device.empty() ? "" : "The hand holds the " + device + ", so no page moves it.") {}

  viewer::ServerSettings settings() {
    viewer::ServerSettings settings;
    settings.resource = [this](std::string_view path) {
      return path == "/" ? viewer::Resource{"text/html; charset=utf-8", page_} : viewer::Resource{};
    };
    settings.on_open = [this](viewer::PageLink& page) {
      page.send_text(hello_);
      page.send_text(shown_.text);
      page.send_binary(shown_.mesh);
    };
    settings.on_text = [this](std::string_view text) { return answer(text); };
    settings.on_frame = [this] { return frame(); };
    return settings;
  }

  void show(Shown shown) { shown_ = std::move(shown); }

 private:
  std::string answer(std::string_view text) {
    viewer::ParsedMessage parsed = viewer::parse_page_message(text);
    if (!parsed.message) return sentence_text("refusal", parsed.refusal);
    if (const auto* hand = std::get_if<viewer::HandRequest>(&*parsed.message)) {
      if (!refusal_of_hands_.empty()) return sentence_text("refusal", refusal_of_hands_);
      feed_.ask(*hand);
    } else {
      wishes_.add(std::get<viewer::SceneRequest>(std::move(*parsed.message)));
    }
    return {};
  }

  Text frame() {
    frame_.samples.clear();
    feed_.drain([this](const viewer::TickSample& sample) { frame_.samples.push_back(sample); });
    const bool is_new = feed_.fetch(frame_.snapshot);
    if (!is_new && frame_.samples.empty()) return nullptr;
    frame_.recognised.clear();
    if (frame_.snapshot.stage == shown_.stage->number())
      frame_.recognised = shown_.stage->watch().recognise(from_device<Pose<double>>(frame_.snapshot.graphic));
    frame_.lost = feed_.lost();
    return shared_text(viewer::encoded(frame_));
  }

  viewer::LiveFeed& feed_;
  Wishes& wishes_;
  Text hello_;
  Shown shown_;
  Text page_;
  std::string refusal_of_hands_;
  viewer::Frame frame_;
};

viewer::SceneRequest first_wish(const Options& options, const std::vector<GalleryEntry>& gallery) {
  viewer::SceneRequest wish;
  const std::string named = options.scene.value_or(gallery.front().id);
  wish.scene = named == "file" && !options.object ? "mesh" : named;
  if (options.is_clearance_given && (named == "cavity" || named == "spline" || named == "shaft")) wish.clearance = options.clearance;
  return wish;
}

Shown build_first(StageBuilder& builder, const viewer::SceneRequest& wish) {
  try {
    return builder.build(wish);
  } catch (const std::invalid_argument& refusal) {
    throw BadInput(refusal.what());
  }
}

}  // namespace

void run_live_view(const Options& options) {
  const std::vector<GalleryEntry> entries = gallery(options);
  const std::unique_ptr<Device> real_device = open_real_device(options.device, choice_of(options));
  if (real_device) check_rate(real_device->specification(), options.rate);
  const std::string device_name = real_device ? real_device->specification().name : "";
  StageBuilder builder(entries, options, real_device.get());
  Shown first = build_first(builder, first_wish(options, entries));

  viewer::LiveFeed feed;
  Wishes wishes;
  StageSwitch stages(first.stage);
  const int first_number = first.stage->number();
  Watcher watcher(feed, wishes, device_name, shared_text(hello_text(entries, options.rate, device_name)), std::move(first));
  const std::unique_ptr<viewer::Server> server = serve(options, watcher.settings());
  if (options.plays) feed.ask({viewer::HandMode::motion, first_number, {}});

  StagedDevice simulated_device(stages, feed);
  RealHand real_hand(stages, feed, real_workspace(options.workspace_scale));
  ServoSettings servo;
  servo.rate = options.rate;
  if (options.view_seconds) servo.tick_limit = std::int64_t(*options.view_seconds * options.rate);
  const auto render_simulated = [&](const ServoTick& tick, const DeviceState& state) { return simulated_device.stage().render(tick, state, feed); };
  const auto render_real = [&](const ServoTick& tick, const DeviceState& state) { return real_hand.render(tick, state); };
  ServoLoop loop = real_device ? ServoLoop(servo, *real_device, render_real) : ServoLoop(servo, simulated_device, render_simulated);

  const Interrupt interrupt;
  for (const std::string& refusal : loop.start().refused) std::printf("  note: %s\n", refusal.c_str());
  server->start();
  announce(*server, "live view");

  while (loop.is_running() && !interrupt.has_come()) {
    const std::optional<viewer::SceneRequest> wish = wishes.wait_for(std::chrono::milliseconds(50));
    if (!wish) continue;
    try {
      const Shown shown = builder.build(*wish);
      server->post([&watcher, shown] { watcher.show(shown); });
      server->broadcast_text(shown.text);
      server->broadcast_binary(shown.mesh);
      stages.offer(shown.stage, [&] { return loop.is_running(); });
    } catch (const std::exception& refusal) {
      server->broadcast_text(shared_text(sentence_text("refusal", refusal.what())));
    }
  }
  loop.stop();
  const ServoReport& report = loop.wait();
  if (real_device) real_device->close();
  std::printf("\n%s", to_string(report).c_str());
  if (!report.problem.empty()) throw std::runtime_error(report.problem);
}

}  // namespace feeler::demo
