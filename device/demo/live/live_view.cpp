// The servo loop, the server that watches it, and this thread, which has built what the pages choose.
#include "live/live_view.hpp"

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bad_input.hpp"
#include "feeler/viewer/page.hpp"
#include "feeler/viewer/page_message.hpp"
#include "feeler/viewer/request_gate.hpp"
#include "feeler/viewer/server.hpp"
#include "feeler/viewer/wire.hpp"
#include "live/interrupt.hpp"
#include "live/own_mesh.hpp"
#include "live/real_hand.hpp"
#include "live/serving.hpp"
#include "live/stage_builder.hpp"
#include "live/stage_description.hpp"
#include "live/stage_switch.hpp"
#include "live/wishes.hpp"
#include "live/workshop.hpp"
#include "real_device.hpp"

namespace feeler::demo {
namespace {

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
      if (work_) page.send_text(work_);
      page.send_text(shown_.text);
      page.send_binary(shown_.mesh);
    };
    settings.on_text = [this](std::string_view text) { return answer(text); };
    settings.on_file = [this](std::string_view target, std::string bytes) {
      wishes_.add(SentFile{viewer::query_text(target, "name"), viewer::query_text(target, "unit"), std::move(bytes)});
      return std::string();
    };
    settings.on_frame = [this] { return frame(); };
    return settings;
  }

  void show(Shown shown) { shown_ = std::move(shown); }
  void greet_with(Text hello) { hello_ = std::move(hello); }
  void say_what_is_built(Text work) { work_ = std::move(work); }

 private:
  std::string answer(std::string_view text) {
    viewer::ParsedMessage parsed = viewer::parse_page_message(text);
    if (!parsed.message) return sentence_text("refusal", parsed.refusal);
    if (const auto* hand = std::get_if<viewer::HandRequest>(&*parsed.message)) {
      if (!refusal_of_hands_.empty()) return sentence_text("refusal", refusal_of_hands_);
      feed_.ask(*hand);
    } else if (auto* scene = std::get_if<viewer::SceneRequest>(&*parsed.message)) {
      wishes_.add(std::move(*scene));
    } else {
      wishes_.add(viewer::CancelRequest());
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
  Text work_;  // none where nothing is being built
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

const GalleryEntry& entry_of(const std::vector<GalleryEntry>& gallery, const std::string& id) {
  if (const GalleryEntry* entry = find_entry(gallery, id)) return *entry;
  throw BadInput("There is no scene " + id + ".");
}

Shown build_first(StageBuilder& builder, const std::vector<GalleryEntry>& gallery, const viewer::SceneRequest& wish) {
  try {
    return builder.build(entry_of(gallery, wish.scene), wish);
  } catch (const std::invalid_argument& refusal) {
    throw BadInput(refusal.what());
  }
}

/// What a wish came to.
struct Built {
  Shown shown;
  std::optional<GalleryEntry> entry = {};  ///< of a file: new in the gallery
  std::string sentence = {};
};

/// Has built what pages wish for, the newest of it, and puts it on show.
class Director {
 public:
  Director(std::vector<GalleryEntry>& gallery, StageBuilder& builder, StageSwitch& stages, Watcher& watcher, viewer::Server& server,
           std::function<Text()> hello, std::function<bool()> is_running)
      : gallery_(gallery),
        builder_(builder),
        stages_(stages),
        watcher_(watcher),
        server_(server),
        hello_(std::move(hello)),
        is_running_(std::move(is_running)) {}

  void begin(Wish wish) {
    try {
      std::visit([this](auto& which) { start(std::move(which)); }, wish);
    } catch (const std::exception& refusal) {
      tell("refusal", sentence_of(refusal));
    }
  }

  /// Shows what is done.
  void advance() {
    try {
      std::optional<Built> built = workshop_.result();
      if (!built) return;
      if (built->entry) add(std::move(*built->entry));
      show(built->shown);
      end("note", built->sentence);
    } catch (const std::exception& refusal) {
      end("refusal", sentence_of(refusal));
    }
  }

 private:
  static constexpr const char* other_choice = "something else was chosen meanwhile.";

  void start(viewer::CancelRequest) {
    if (!workshop_.is_busy()) return;
    make_way("it was cancelled.");
    workshop_.abandon();
    end("note", "");
  }

  void start(const viewer::SceneRequest& request) {
    const GalleryEntry entry = entry_of(gallery_, request.scene);
    make_way(other_choice);
    say_what_is_built("Building " + entry.title + " …");
    workshop_.begin([this, entry, request](const std::stop_token& stop) { return Built{builder_.build(entry, request, stop)}; });
  }

  void start(SentFile sent) {
    make_way(other_choice);
    file_ = sent.name;
    say_what_is_built("Opening " + sent.name + " …");
    workshop_.begin([this, number = ++own_meshes_, file = std::make_shared<const SentFile>(std::move(sent))](const std::stop_token& stop) {
      Built built;
      built.entry = own_mesh_entry(*file, number, stop);
      go_on_unless(stop);
      built.shown = builder_.build(*built.entry, {}, stop);
      built.sentence = sentence_of(*file, *built.entry, built.shown.stage->object().report());
      return built;
    });
  }

  void say_what_is_built(const std::string& work) {
    const Text text = shared_text(sentence_text("work", work));
    server_.post([&watcher = watcher_, text = work.empty() ? nullptr : text] { watcher.say_what_is_built(text); });
    server_.broadcast_text(text);
  }

  void make_way(const std::string& why) {
    if (!file_.empty()) left_ = file_ + " was not opened: " + why;
    file_.clear();
  }

  /// Nothing is being built any more.
  void end(const char* type, std::string sentence) {
    file_.clear();
    say_what_is_built("");
    if (!left_.empty()) sentence = sentence.empty() ? left_ : left_ + ' ' + sentence;
    left_.clear();
    if (!sentence.empty()) tell(type, sentence);
  }
  void tell(const char* type, const std::string& sentence) { server_.broadcast_text(shared_text(sentence_text(type, sentence))); }

  void add(GalleryEntry entry) {
    put_own_mesh_first(gallery_, std::move(entry));
    server_.post([&watcher = watcher_, hello = hello_()] { watcher.greet_with(hello); });
    server_.broadcast_text(shared_text(gallery_text(gallery_)));
  }

  void show(const Shown& shown) {
    server_.post([&watcher = watcher_, shown] { watcher.show(shown); });
    server_.broadcast_text(shown.text);
    server_.broadcast_binary(shown.mesh);
    stages_.offer(shown.stage, is_running_);
  }

  std::vector<GalleryEntry>& gallery_;
  StageBuilder& builder_;
  StageSwitch& stages_;
  Watcher& watcher_;
  viewer::Server& server_;
  std::function<Text()> hello_;
  std::function<bool()> is_running_;
  int own_meshes_ = 0;
  std::string file_;  // that is being opened; empty for none
  std::string left_;  // a sentence of the file that made way
  Workshop<Built> workshop_;
};

}  // namespace

void run_live_view(const Options& options) {
  std::vector<GalleryEntry> entries = gallery(options);
  const std::unique_ptr<Device> real_device = open_real_device(options.device, choice_of(options));
  if (real_device) check_rate(real_device->specification(), options.rate);
  const std::string device_name = real_device ? real_device->specification().name : "";
  StageBuilder builder(options, real_device.get());
  Shown first = build_first(builder, entries, first_wish(options, entries));
  const auto hello = [&] { return shared_text(hello_text(entries, options.rate, device_name)); };

  viewer::LiveFeed feed;
  Wishes wishes;
  StageSwitch stages(first.stage);
  const int first_number = first.stage->number();
  Watcher watcher(feed, wishes, device_name, hello(), std::move(first));
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
  announce(*server, options, "live view");

  Director director(entries, builder, stages, watcher, *server, hello, [&] { return loop.is_running(); });
  while (loop.is_running() && !interrupt.has_come()) {
    if (std::optional<Wish> wish = wishes.wait_for(std::chrono::milliseconds(20))) director.begin(std::move(*wish));
    director.advance();
  }
  loop.stop();
  const ServoReport& report = loop.wait();
  if (real_device) real_device->close();
  std::printf("\n%s", to_string(report).c_str());
  if (!report.problem.empty()) throw std::runtime_error(report.problem);
}

}  // namespace feeler::demo
